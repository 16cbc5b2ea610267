#include "modules/sources/simulated_odometry.hpp"

#include <algorithm>

#include "framework/core/rng.hpp"

namespace ppm {
namespace {

bool jumped(const std::vector<double>& jumps_s, double after_s, double until_s) {
  const auto next = std::upper_bound(jumps_s.begin(), jumps_s.end(), after_s);
  return next != jumps_s.end() && *next <= until_s;
}

}  // namespace

std::vector<Pose> SimulatedOdometry::poses(const std::vector<StampedPose>& path, const std::vector<double>& jumps_s,
                                           std::uint64_t seed) const {
  const std::uint32_t purpose = purpose_key("simulated_odometry/step");
  std::vector<Pose> out;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i == 0) {
      out.push_back(Pose::Identity());
      continue;
    }
    const bool counted = !jumped(jumps_s, path[i - 1].stamp_s, path[i].stamp_s);
    const Pose step = counted ? path[i - 1].T_map_camera.inverse() * path[i].T_map_camera : Pose::Identity();
    const double length = step.translation().norm(), turn = rotation_angle(step);
    Rng rng(seed, static_cast<std::uint32_t>(i), 0, purpose);
    Twist noise;
    for (int k = 0; k < 6; ++k)
      noise[k] = rng.normal() * (k < 3 ? t_per_m * length + t_per_rad * turn : r_per_m * length + r_per_rad * turn);
    out.push_back(out.back() * step * se3_exp(noise));
  }
  return out;
}

}  // namespace ppm
