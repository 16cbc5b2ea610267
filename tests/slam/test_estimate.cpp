#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/rng.hpp"
#include "framework/slam/estimate.hpp"

namespace {

using namespace ppm;

/// Weights in proportion to `weight`.
ParticleSet belief_of(const std::vector<Pose>& poses, const std::vector<double>& weight) {
  ParticleSet belief;
  belief.init(poses.size(), Pose::Identity(), nullptr);
  belief.pose = poses;
  for (std::size_t i = 0; i < poses.size(); ++i) belief.log_weight[i] = std::log(weight[i]);
  belief.normalize();
  return belief;
}

Pose turned(double x, double about_z) {
  Pose T = Pose::Identity();
  T.translation().x() = x;
  T.rotate(Eigen::AngleAxisd(about_z, Eigen::Vector3d::UnitZ()));
  return T;
}

Pose center() {
  Twist xi;
  xi << 1, -2, 3, 0.5, 1, -2;
  return se3_exp(xi);
}

std::vector<Pose> cloud(const Pose& middle, double sigma_t, double sigma_r, std::size_t n, std::uint32_t seed) {
  Rng rng(seed, 0, 0, 0);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < n; ++i) {
    Twist xi;
    for (int k = 0; k < 6; ++k) xi[k] = (k < 3 ? sigma_t : sigma_r) * rng.normal();
    poses.push_back(middle * se3_exp(xi));
  }
  return poses;
}

double distance(const Pose& a, const Pose& b) {
  const Pose off = a.inverse() * b;
  return off.translation().norm() + rotation_angle(off);
}

}  // namespace

TEST_CASE("mean and spread of two poses, weighted") {
  const auto belief = belief_of({turned(0, 0), turned(1, 0.4)}, {3, 1});
  const Pose mean = mean_pose(belief);
  CHECK(mean.translation().x() == Approx(0.25));
  // The chordal mean of rotations about one axis: the angle of the weighted sum of their unit vectors.
  CHECK(rotation_angle(mean) == Approx(std::atan2(0.25 * std::sin(0.4), 0.75 + 0.25 * std::cos(0.4))));
  const auto s = spread(belief);
  CHECK(s.translation_m == Approx(std::sqrt(0.75 * 0.0625 + 0.25 * 0.5625)));
  CHECK(s.rotation_rad == Approx(0.4 * std::sqrt(3.0 / 16)).epsilon(0.01));
}

TEST_CASE("of one place, all three estimates say the same") {
  const auto poses = cloud(center(), 0.02, 0.01, 400, 1);
  const auto belief = belief_of(poses, std::vector<double>(400, 1.0));
  CHECK(distance(estimate_pose(belief, Estimate::best), poses[0]) < 1e-9);
  CHECK(distance(estimate_pose(belief, Estimate::mean), center()) < 0.005);
  CHECK(distance(estimate_pose(belief, Estimate::mode), center()) < 0.025);
  CHECK(spread(belief).translation_m == Approx(0.02 * std::sqrt(3.0)).epsilon(0.1));
  CHECK(spread(belief).rotation_rad == Approx(0.01 * std::sqrt(3.0)).epsilon(0.1));
}

TEST_CASE("of two places the mode is the one with more weight, the mean is neither") {
  const Pose other = center() * turned(1, 0.8);
  auto poses = cloud(center(), 0.01, 0.01, 60, 2);
  const auto second = cloud(other, 0.01, 0.01, 40, 3);
  poses.insert(poses.end(), second.begin(), second.end());
  std::vector<double> weight(100, 1.0);
  weight[70] = 5;  // the best particle stands in the lesser place
  const auto belief = belief_of(poses, weight);
  CHECK(distance(estimate_pose(belief, Estimate::best), other) < 0.1);
  CHECK(distance(mode_pose(belief), center()) < 0.1);
  CHECK(distance(mean_pose(belief), center()) > 0.3);
  CHECK(distance(mean_pose(belief), other) > 0.3);
  // Weight counts, not numbers.
  for (std::size_t i = 60; i < 100; ++i) weight[i] = 4;
  CHECK(distance(mode_pose(belief_of(poses, weight)), other) < 0.1);
}

TEST_CASE("one particle, and many at one place, are their own estimate") {
  for (std::size_t n : {std::size_t{1}, std::size_t{5}}) {
    const auto belief = belief_of(std::vector<Pose>(n, center()), std::vector<double>(n, 1.0));
    for (const auto& [name, estimate] : estimate_names()) {
      CHECK(to_string(estimate) == name);
      CHECK(distance(estimate_pose(belief, estimate), center()) < 1e-9);
    }
    CHECK(spread(belief).translation_m == Approx(0).margin(1e-9));
  }
}
