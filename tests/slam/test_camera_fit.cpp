#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "framework/core/error.hpp"
#include "framework/core/rng.hpp"
#include "framework/slam/camera_fit.hpp"

using namespace ppm;
using Catch::Matchers::Contains;

namespace {

const Camera kCamera{96, 72, 90, 90, 47.5, 35.5};

/// Depth along a ray, from inside the box |x| < 2, |y| < 1.5, |z| < 2.5 with another one, 0.6 wide, in its middle.
double depth(const Pose& T, const Eigen::Vector3d& ray) {
  const Eigen::Vector3d d = T.linear() * ray, o = T.translation();
  const Eigen::Vector3d size(2, 1.5, 2.5);
  double walls = std::numeric_limits<double>::infinity(), enter = 0, leave = walls;
  for (int k = 0; k < 3; ++k) {
    walls = std::min(walls, (std::copysign(size[k], d[k]) - o[k]) / d[k]);
    enter = std::max(enter, (-std::copysign(0.3, d[k]) - o[k]) / d[k]);
    leave = std::min(leave, (std::copysign(0.3, d[k]) - o[k]) / d[k]);
  }
  return enter < leave && enter > 0 ? enter : walls;
}

/// A camera that walks round the middle box and looks at it, and at the walls behind, tilted up and down.
std::vector<CalibrationFrame> walk(int frames) {
  std::vector<CalibrationFrame> out;
  for (int i = 0; i < frames; ++i) {
    const double angle = 2 * EIGEN_PI * i / frames;
    CalibrationFrame frame;
    frame.T_world_camera.linear() = (Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(0.4 * std::sin(3 * angle), Eigen::Vector3d::UnitX())).toRotationMatrix();
    frame.T_world_camera.translation() = 1.3 * Eigen::Vector3d(-std::sin(angle), 0.2 * std::cos(2 * angle), -std::cos(angle));
    Frame image;
    image.camera = kCamera;
    Rng rng(1, static_cast<std::uint32_t>(i), 0, 0);
    for (int y = 0; y < kCamera.rows; ++y)
      for (int x = 0; x < kCamera.cols; ++x)
        image.depth.push_back(static_cast<float>(depth(frame.T_world_camera, kCamera.ray(x, y)) + 0.004 * rng.normal()));
    image.sigma.assign(image.depth.size(), 0.004f);
    frame.patches = surface_patches(image, 3);
    out.push_back(std::move(frame));
  }
  return out;
}

FramePair pair_at(double tilt_rad) {
  return {0, 1, 0.5, tilt_rad};
}

}  // namespace

TEST_CASE("a wrong camera is found from frames that see the same surfaces, within its stated uncertainty") {
  const auto frames = walk(40);
  CameraParameters parameters;
  parameters.free = {CameraParameter::focal, CameraParameter::cx,     CameraParameter::cy,
                     CameraParameter::bend,  CameraParameter::bend_x, CameraParameter::bend_y};
  const CameraCorrection wrong{.focal_scale = 0.96, .cx_shift = 1, .cy_shift = -1, .depth_bend = 0.01,
                               .depth_bend_x = -0.01, .depth_bend_y = 0.01};
  const Workers one(1), two(2);
  const auto pairs = overlapping_pairs(frames, wrong, 0.3, 0.2, one);
  REQUIRE(pairs.size() > frames.size());
  check_observable(pairs);
  const auto fit = fit_camera(frames, pairs, wrong, parameters, one);
  CHECK(fit.converged);
  check_found(fit, parameters);
  const CameraCorrection& c = fit.correction;
  CHECK(std::abs(c.focal_scale - 1) < 0.003);
  const double off[] = {c.focal_scale - 1, c.cx_shift, c.cy_shift, c.depth_bend, c.depth_bend_x, c.depth_bend_y};
  for (Eigen::Index k = 0; k < parameters.size(); ++k) {
    INFO(to_string(parameters.free[static_cast<std::size_t>(k)]) << " off by " << off[k] << ", stated " << fit.sigma(k));
    CHECK(std::abs(off[k]) < 4 * fit.sigma(k));
  }
  CHECK(fit.distance_m < fit.distance_before_m);
  const auto same = fit_camera(frames, pairs, wrong, parameters, two);
  CHECK(same.correction == fit.correction);
}

TEST_CASE("cameras that cannot be seen are refused with the reason") {
  CHECK_THROWS_WITH(check_observable({pair_at(0.01), pair_at(0.02)}), Contains("focal length cannot be seen"));
  CHECK_NOTHROW(check_observable({pair_at(0.01), pair_at(0.2)}));
  CameraParameters parameters;
  parameters.free = {CameraParameter::focal, CameraParameter::bend};
  CameraFit fit;
  fit.covariance = Eigen::Vector2d(1e-6, 1e-2).asDiagonal();
  CHECK_THROWS_WITH(check_found(fit, parameters), Contains("depth_bend cannot be told") && Contains("0.1"));
  fit.covariance(1, 1) = 1e-6;
  CHECK_NOTHROW(check_found(fit, parameters));
}

TEST_CASE("a step of the bend leaves the depth at the pivot what it was") {
  CameraParameters parameters;
  parameters.free = {CameraParameter::bend};
  parameters.pivot_m = 2;
  const CameraCorrection from{.depth_factor = 1.02, .depth_bend = 0.01};
  const auto to = parameters.moved(from, Eigen::VectorXd::Constant(1, 0.03));
  CHECK(to.depth_bend == Approx(0.04));
  CHECK(to.depth(2, to.depth_bend) == Approx(from.depth(2, from.depth_bend)));
}
