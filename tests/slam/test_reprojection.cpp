#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "framework/core/error.hpp"
#include "framework/slam/reprojection.hpp"

namespace {

using namespace ppm;

constexpr Camera kCamera{80, 60, 70, 70, 39.5, 29.5};

/// What a camera in a room sees: a slanted wall, and a pillar 1 m in front of it at x < 0.
Frame view(const Pose& T_room_camera) {
  Frame f;
  f.camera = kCamera;
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, 0.1, 1).normalized();
  for (int y = 0; y < kCamera.rows; ++y)
    for (int x = 0; x < kCamera.cols; ++x) {
      const Eigen::Vector3d ray = T_room_camera.linear() * kCamera.ray(x, y), eye = T_room_camera.translation();
      double depth = (3 - normal.dot(eye)) / normal.dot(ray);
      const double pillar = (1.5 - eye.z()) / ray.z();
      if ((eye + pillar * ray).x() < -0.5) depth = pillar;
      f.depth.push_back(static_cast<float>(depth));
    }
  return f;
}

Pose shifted(double x, double turn = 0) {
  Twist xi;
  xi << x, 0.02, -0.03, 0, turn, 0;
  return se3_exp(xi);
}

ReprojectionError error_of(const PosedImage& a, const PosedImage& b) {
  ReprojectionScorer scorer;
  scorer.add(a, b);
  return scorer.score();
}

}  // namespace

TEST_CASE("with the true poses images agree, up to what one hides from the other") {
  const PosedImage a(view(shifted(0)), shifted(0)), b(view(shifted(0.2, 0.1)), shifted(0.2, 0.1));
  const auto error = error_of(a, b);
  CHECK(error.pairs == 1);
  CHECK(error.pixels > 4000);
  CHECK(error.median_mm < 0.01);
  CHECK(error.mean_mm < 1);
  CHECK(error.beyond_10cm < 0.1);
}

TEST_CASE("a pose that is off by so much along the wall's normal is an error of that") {
  const PosedImage a(view(shifted(0)), shifted(0));
  Pose off = shifted(0.2);
  off.translation().z() += 0.02;
  const auto error = error_of(a, PosedImage(view(shifted(0.2)), off));
  CHECK(error.median_mm == Approx(20).epsilon(0.1));
  off.translation().z() += 0.5;
  const auto lost = error_of(a, PosedImage(view(shifted(0.2)), off));
  CHECK(lost.beyond_10cm == 1);
  CHECK(std::isnan(lost.median_mm));
}

TEST_CASE("pixels without a return, and those at jumps, are not compared") {
  Frame frame = view(shifted(0));
  const PosedImage whole(frame, shifted(0));
  CHECK(std::isnan(whole.smooth_depth(0, 5)));  // the border
  bool jump_left_out = false;
  for (int x = 1; x + 1 < kCamera.cols; ++x)
    jump_left_out |= std::isnan(whole.smooth_depth(x, 30)) && std::abs(whole.depth(x + 1, 30) - whole.depth(x - 1, 30)) > 0.5f;
  CHECK(jump_left_out);
  CHECK(whole.smooth_depth(60, 30) == whole.depth(60, 30));
  frame.depth[30 * 80 + 60] = std::numeric_limits<float>::quiet_NaN();
  const PosedImage hole(frame, shifted(0));
  for (int y : {29, 30, 31})
    for (int x : {59, 60, 61}) CHECK(std::isnan(hole.smooth_depth(x, y)));
  CHECK(std::isnan(hole.smooth_depth_at({60.5, 30.5})));
  CHECK(whole.smooth_depth_at({60, 30}) == Approx(whole.depth(60, 30)));

  Frame blind = view(shifted(0));
  blind.depth.assign(blind.depth.size(), std::numeric_limits<float>::quiet_NaN());
  ReprojectionScorer scorer;
  scorer.add(whole, PosedImage(blind, shifted(0)));
  CHECK(scorer.empty());
  CHECK_THROWS_AS(scorer.score(), DataError);
  CHECK(overlap(PosedImage(blind, shifted(0)), whole) == 0);
}

TEST_CASE("overlap falls with what leaves the view, and is none for views from the side") {
  const PosedImage a(view(shifted(0)), shifted(0));
  CHECK(overlap(a, a) == 1);
  const double half = overlap(a, PosedImage(view(shifted(0, 0.5)), shifted(0, 0.5)));
  CHECK(half > 0.2);
  CHECK(half < 0.8);
  CHECK(overlap(a, PosedImage(view(shifted(0)), shifted(0, 1.2))) == 0);
}
