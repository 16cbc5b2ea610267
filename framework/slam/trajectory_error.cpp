#include "framework/slam/trajectory_error.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "framework/core/error.hpp"
#include "framework/core/timing.hpp"

namespace ppm {

namespace {

struct Pair {
  StampedPose estimated;
  Pose reference;
};

/// Two poses that may be one another's partner.
struct Candidate {
  double dt_s;
  std::size_t estimated, reference;
  bool operator<(const Candidate& other) const {
    return std::tie(dt_s, estimated, reference) < std::tie(other.dt_s, other.estimated, other.reference);
  }
};

/// All poses at most max_dt_s apart, nearest first.
std::vector<Candidate> candidates(const std::vector<StampedPose>& estimated, const std::vector<StampedPose>& reference,
                                  double max_dt_s) {
  std::vector<Candidate> all;
  std::size_t first = 0;  // of the references that are not too early for the estimates that are left
  for (std::size_t e = 0; e < estimated.size(); ++e) {
    auto dt = [&](std::size_t r) { return reference[r].stamp_s - estimated[e].stamp_s; };
    while (first < reference.size() && dt(first) < -max_dt_s) ++first;
    for (std::size_t r = first; r < reference.size() && dt(r) <= max_dt_s; ++r) all.push_back({std::abs(dt(r)), e, r});
  }
  std::ranges::sort(all, std::less<>());
  return all;
}

/// Source: the greedy rule of the TUM RGB-D benchmark's associate.py.
std::vector<Pair> associate(const std::vector<StampedPose>& estimated, const std::vector<StampedPose>& reference,
                            double max_dt_s) {
  const std::size_t nobody = reference.size();
  std::vector<std::size_t> partner(estimated.size(), nobody);
  std::vector<bool> taken(reference.size(), false);
  for (const auto& c : candidates(estimated, reference, max_dt_s)) {
    if (partner[c.estimated] != nobody || taken[c.reference]) continue;
    partner[c.estimated] = c.reference;
    taken[c.reference] = true;
  }
  std::vector<Pair> pairs;
  for (std::size_t e = 0; e < estimated.size(); ++e)
    if (partner[e] != nobody) pairs.push_back({estimated[e], reference[partner[e]].T_map_camera});
  return pairs;
}

ErrorStatistics statistics(std::vector<double> errors) {
  ErrorStatistics out;
  double squares = 0;
  for (double e : errors) squares += e * e;
  out.rmse = std::sqrt(squares / static_cast<double>(errors.size()));
  out.mean = mean(errors);
  std::ranges::sort(errors);
  const std::size_t middle = errors.size() / 2;
  out.median = errors.size() % 2 ? errors[middle] : (errors[middle - 1] + errors[middle]) / 2;
  out.max = errors.back();
  return out;
}

void absolute_error(const std::vector<Pair>& pairs, TrajectoryError& error) {
  const auto n = static_cast<Eigen::Index>(pairs.size());
  Eigen::Matrix3Xd estimated(3, n), reference(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    estimated.col(i) = pairs[static_cast<std::size_t>(i)].estimated.T_map_camera.translation();
    reference.col(i) = pairs[static_cast<std::size_t>(i)].reference.translation();
  }
  error.T_ref_est.matrix() = Eigen::umeyama(estimated, reference, false);
  std::vector<double> errors;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& pose = pairs[static_cast<std::size_t>(i)].estimated;
    errors.push_back((error.T_ref_est * estimated.col(i) - reference.col(i)).norm());
    error.poses.push_back({pose.frame, pose.stamp_s, errors.back()});
  }
  error.ate_m = statistics(std::move(errors));
}

void relative_error(const std::vector<Pair>& pairs, std::size_t delta, TrajectoryError& error) {
  std::vector<double> translation, rotation;
  for (std::size_t i = 0; i + delta < pairs.size(); ++i) {
    const Pose step_estimated = pairs[i].estimated.T_map_camera.inverse() * pairs[i + delta].estimated.T_map_camera;
    const Pose step_reference = pairs[i].reference.inverse() * pairs[i + delta].reference;
    const Pose off = step_reference.inverse() * step_estimated;
    translation.push_back(off.translation().norm());
    rotation.push_back(rotation_angle(off) * 180 / std::numbers::pi);
  }
  error.rpe_trans_m = statistics(std::move(translation));
  error.rpe_rot_deg = statistics(std::move(rotation));
}

}  // namespace

TrajectoryError trajectory_error(const std::vector<StampedPose>& estimated, const std::vector<StampedPose>& reference,
                                 double max_dt_s, int delta) {
  PPM_CHECK(delta >= 1, "delta {}", delta);
  const auto pairs = associate(estimated, reference, max_dt_s);
  const auto needed = std::max<std::size_t>(2, static_cast<std::size_t>(delta) + 1);
  if (pairs.size() < needed)
    throw DataError("the trajectory",
                    fmt::format("only {} of its {} poses have a reference pose within {} s; {} are needed",
                                pairs.size(), estimated.size(), max_dt_s, needed));
  TrajectoryError error;
  error.pairs = static_cast<int>(pairs.size());
  absolute_error(pairs, error);
  relative_error(pairs, static_cast<std::size_t>(delta), error);
  return error;
}

}  // namespace ppm
