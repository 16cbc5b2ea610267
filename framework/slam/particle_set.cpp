#include "framework/slam/particle_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ppm {

void ParticleSet::init(std::size_t n, const Pose& T_map_camera, MapHandle map_handle) {
  PPM_CHECK(n > 0, "a belief needs a particle");
  pose.assign(n, T_map_camera);
  log_weight.assign(n, -std::log(static_cast<double>(n)));
  trajectory.assign(n, Trajectory());
  map.assign(n, std::move(map_handle));
  prediction.assign(n, nullptr);
  T_map_world = Pose::Identity();
  lost = false;
  for (auto& [name, column] : columns_) column->resize(n);
}

void ParticleSet::extend(std::size_t i, const StampedPose& next) {
  pose[i] = next.T_map_camera;
  trajectory[i].extend(next);
  prediction[i].reset();
}

void ParticleSet::correct(std::size_t i, const Pose& T_map_camera) {
  PPM_CHECK(!trajectory[i].empty(), "particle {} has no pose of this frame to correct", i);
  StampedPose last = trajectory[i].last();
  last.T_map_camera = T_map_camera;
  trajectory[i] = trajectory[i].parent();
  trajectory[i].extend(last);
  pose[i] = T_map_camera;
}

void ParticleSet::gather(const std::vector<std::uint32_t>& ancestors) {
  PPM_CHECK(!ancestors.empty(), "a belief needs a particle");
  for (auto a : ancestors) PPM_CHECK(a < size(), "ancestor {} of {} particles", a, size());
  ppm::gather(pose, ancestors);
  ppm::gather(log_weight, ancestors);
  ppm::gather(trajectory, ancestors);
  ppm::gather(map, ancestors);
  ppm::gather(prediction, ancestors);
  for (auto& [name, column] : columns_) column->gather(ancestors);
}

double ParticleSet::normalize() {
  double largest = -std::numeric_limits<double>::infinity();
  for (double w : log_weight) {
    PPM_CHECK(!std::isnan(w), "a log weight is not a number");
    largest = std::max(largest, w);
  }
  PPM_CHECK(std::isfinite(largest), "no particle has a finite log weight (the largest is {})", largest);
  double sum = 0;
  for (double w : log_weight) sum += std::exp(w - largest);
  const double log_sum = largest + std::log(sum);
  for (double& w : log_weight) w -= log_sum;
  return log_sum;
}

double ParticleSet::ess() const {
  double squares = 0;
  for (double w : log_weight) squares += std::exp(2 * w);
  return std::clamp(1 / squares, 1.0, static_cast<double>(size()));
}

std::size_t ParticleSet::best() const {
  PPM_CHECK(size() > 0, "the belief has no particle");
  return static_cast<std::size_t>(std::max_element(log_weight.begin(), log_weight.end()) - log_weight.begin());
}

}  // namespace ppm
