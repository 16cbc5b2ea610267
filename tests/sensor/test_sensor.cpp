#include <catch2/catch.hpp>

#include "framework/graph/harness.hpp"
#include "framework/slam/tof_noise.hpp"
#include "tests/support/plane_image.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

const Camera kCamera{40, 30, 100, 100, 19.5, 14.5};

std::shared_ptr<const Frame> run(const std::string& module, const std::string& params, const Frame& frame) {
  Harness h(builtin(), module, params);
  h.input("frame", std::make_shared<const Frame>(frame));
  h.tick();
  return h.output<Frame>("frame");
}

Frame wall(double depth) {
  return plane_image(kCamera, {0, 0, 1}, depth);
}

std::size_t at(int x, int y) {
  return static_cast<std::size_t>(y * kCamera.cols + x);
}

}  // namespace

TEST_CASE("a sensor model replaces the noise and leaves all else") {
  const std::string module = GENERATE("sensor.constant", "sensor.kinect", "sensor.tof");
  INFO(module);
  Frame image = wall(2);
  image.index = 7;
  image.stamp_s = 0.25;
  image.depth[at(3, 4)] = kNoReturn;
  image.sigma.clear();
  image.lateral_px = 9;
  image.color.assign(3 * image.depth.size(), 5);
  image.confidence.assign(image.depth.size(), 400);
  image.T_world_camera_ref = Pose::Identity();
  const auto out = run(module, "{}", image);
  CHECK(out->index == 7);
  CHECK(out->stamp_s == 0.25);
  CHECK(out->camera == kCamera);
  CHECK(out->color == image.color);
  CHECK(out->confidence == image.confidence);
  CHECK(out->T_world_camera_ref.has_value());
  CHECK(out->lateral_px < 1);
  REQUIRE(out->sigma.size() == image.depth.size());
  for (std::size_t p = 0; p < image.depth.size(); ++p) {
    CHECK(std::isnan(out->depth[p]) == (p == at(3, 4)));
    CHECK(std::isnan(out->sigma[p]) == (p == at(3, 4)));
    if (p != at(3, 4)) CHECK(out->sigma[p] > 0);
  }
}

TEST_CASE("sensor.constant gives what it is told") {
  const auto out = run("sensor.constant", "{sigma: 4 mm, sigma_lateral: 0.3}", wall(3));
  CHECK(out->sigma[at(5, 5)] == 0.004f);
  CHECK(out->lateral_px == 0.3f);
}

TEST_CASE("sensor.kinect grows with the square of the distance, and is lateral in pixels of its own image") {
  for (double z : {0.4, 1.0, 3.0}) {
    const auto out = run("sensor.kinect", "{}", wall(z));
    CHECK(out->sigma[at(20, 15)] == Approx(0.0012 + 0.0019 * (z - 0.4) * (z - 0.4)).epsilon(1e-4));
    CHECK(out->lateral_px == Approx(0.88 * 100 / 585));
  }
}

TEST_CASE("sensor.kinect adds the noise of grazing views beyond 60 degrees of incidence") {
  for (double degrees : {50.0, 70.0, 80.0}) {
    const double tilt = degrees * EIGEN_PI / 180;
    // The plane crosses the optical axis at z = 2; the angle there is the tilt.
    const Frame image = plane_image(kCamera, {std::sin(tilt), 0, std::cos(tilt)}, 2 * std::cos(tilt));
    const std::size_t centre = at(19, 14);
    const Eigen::Vector3d ray = kCamera.ray(19, 14).normalized();
    const double angle = std::acos(std::sin(tilt) * ray.x() + std::cos(tilt) * ray.z());
    const double z = image.depth[centre], axial = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
    const double ratio = angle / (EIGEN_PI / 2 - angle);
    const double expected = degrees > 60 ? axial + 1e-4 / std::sqrt(z) * ratio * ratio : axial;
    CHECK(run("sensor.kinect", "{}", image)->sigma[centre] == Approx(expected).epsilon(0.01));
    CHECK(run("sensor.kinect", "{grazing: false}", image)->sigma[centre] == Approx(axial).epsilon(1e-4));
  }
}

TEST_CASE("sensor.tof follows range and amplitude, along the ray") {
  Frame image = wall(2);
  const std::size_t corner = at(0, 0), centre = at(20, 15);
  const double length = kCamera.ray(0, 0).norm(), range = 2 * length;
  const std::string params = "{sigma_floor: 1 cm, signal_noise: 3, sigma_quadratic: 0.01}";
  CHECK(run("sensor.tof", params, image)->sigma[corner] == Approx(std::hypot(0.01, 0.01 * range * range) / length));
  image.confidence.assign(image.depth.size(), 500);
  image.confidence[centre] = 0;
  const auto out = run("sensor.tof", params, image);
  CHECK(out->sigma[corner] == Approx(std::hypot(0.01, 3 * range * range / 500) / length));
  CHECK(out->sigma[centre] == Approx(1.0).epsilon(1e-3));
  CHECK(out->lateral_px == 0.29f);
  const auto raw = run("sensor.tof", "{sigma_floor: 1 cm, signal_noise: 3, range_corrected: false}", image);
  CHECK(raw->sigma[corner] == Approx(std::hypot(0.01, 3.0 / 500) / length));
  CHECK(TofNoise{.most = 0.02}.sigma(5, 1) == 0.02);
}

TEST_CASE("noise of nothing is refused") {
  CHECK_THROWS_AS(run("sensor.constant", "{sigma: 0}", wall(1)), ConfigError);
  CHECK_THROWS_AS(run("sensor.kinect", "{sigma_lateral: -1}", wall(1)), ConfigError);
  CHECK_THROWS_AS(run("sensor.tof", "{sigma_floor: 2 deg}", wall(1)), ConfigError);
}
