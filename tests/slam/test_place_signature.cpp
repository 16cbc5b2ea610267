#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "framework/slam/place_signature.hpp"

using namespace ppm;

namespace {

const Camera kCamera{80, 60, 80, 80, 39.5, 29.5};

/// The range along a direction to a box room, 6 x 5 x 1.6 m, from a point in it, with one thick pillar.
double room_range(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d half(3, 2.5, 0.8);
  for (int axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    if (d != 0) nearest = std::min(nearest, ((d > 0 ? half[axis] : -half[axis]) - from[axis]) / d);
  }
  const Eigen::Vector2d p = from.head<2>() - Eigen::Vector2d(1.5, 0.4), d = direction.head<2>();
  const double b = p.dot(d), discriminant = b * b - d.squaredNorm() * (p.squaredNorm() - 0.09);
  if (discriminant > 0 && -b - std::sqrt(discriminant) > 0)
    nearest = std::min(nearest, (-b - std::sqrt(discriminant)) / d.squaredNorm());
  return nearest;
}

/// Looks along the room's x axis, turned to the left and upwards.
Pose camera_at(double x, double y, double left_rad, double up_rad = 0) {
  Eigen::Matrix3d axes;
  axes << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::AngleAxisd left(left_rad, Eigen::Vector3d::UnitZ()), up(-up_rad, Eigen::Vector3d::UnitY());
  Pose T = Eigen::Translation3d(x, y, 0) * Pose(left * up);
  T.linear() = T.linear() * axes;
  return T;
}

Frame frame_at(const Pose& T) {
  Frame frame;
  frame.camera = kCamera;
  for (int y = 0; y < kCamera.rows; ++y)
    for (int x = 0; x < kCamera.cols; ++x) {
      const Eigen::Vector3d ray = kCamera.ray(x, y);
      const double range = room_range(T.translation(), T.linear() * ray.normalized());
      frame.depth.push_back(static_cast<float>(range / ray.norm()));
    }
  return frame;
}

Prediction view_at(const Pose& T) {
  Prediction view;
  view.reset(kCamera, 1, T);
  for (std::size_t p = 0; p < view.range.size(); ++p)
    view.range[p] = static_cast<float>(room_range(T.translation(), view.direction(p)));
  return view;
}

double turn_error(const Pose& known, const Pose& seen) {
  const auto match = best_match(PlaceSignature::of(frame_at(seen)), PlaceSignature::of(view_at(known)), 6, 4);
  return rotation_angle((known * turn_of(match, kCamera)).inverse() * seen);
}

}  // namespace

TEST_CASE("a frame and a view of one place have one signature") {
  const Pose T = camera_at(-1, 0.5, 0.3);
  const auto match = best_match(PlaceSignature::of(frame_at(T)), PlaceSignature::of(view_at(T)), 6, 4);
  CHECK(match.difference < 1e-4);
  CHECK(match.cols == 0);
  CHECK(match.rows == 0);
}

TEST_CASE("the shift between signatures tells the turn between the cameras, both ways and up and down") {
  const double cell = 2 * std::atan(0.5 * 4 / kCamera.fx);
  for (double left : {-0.25, -0.1, 0.1, 0.25}) CHECK(turn_error(camera_at(-1, 0.5, 0.2), camera_at(-1, 0.5, 0.2 + left)) < cell);
  for (double up : {-0.15, 0.15}) CHECK(turn_error(camera_at(-1, 0.5, 0.2), camera_at(-1, 0.5, 0.2, up)) < cell);
}

TEST_CASE("the right place is more alike than others, from some way off") {
  const auto seen = PlaceSignature::of(frame_at(camera_at(-0.95, 0.45, 0.33)));
  const double right = best_match(seen, PlaceSignature::of(view_at(camera_at(-1, 0.5, 0.2))), 6, 4).difference;
  for (const Pose& other : {camera_at(-1, 0.5, 2), camera_at(-1, 0.5, -1.2), camera_at(1, -1, 0.2), camera_at(0.5, 1.5, 0.3)})
    CHECK(best_match(seen, PlaceSignature::of(view_at(other)), 6, 4).difference > 2 * right);
}

TEST_CASE("cells that a view does not know cost less than wrong ones, and more than right ones") {
  const Pose T = camera_at(-1, 0.5, 0.3);
  const auto seen = PlaceSignature::of(frame_at(T));
  auto view = view_at(T);
  for (std::size_t p = 0; p < view.range.size() / 2; ++p) view.range[p] = Prediction::kMiss;
  const auto half_known = best_match(seen, PlaceSignature::of(view), 0, 0);
  CHECK(half_known.difference == Approx(0.5 * SignatureMatch::kUnknown).epsilon(0.1));
  std::ranges::fill(view.range, Prediction::kMiss);
  CHECK(best_match(seen, PlaceSignature::of(view), 6, 4).difference == Approx(SignatureMatch::kUnknown));
}
