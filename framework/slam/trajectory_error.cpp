#include "framework/slam/trajectory_error.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

struct Pair {
  Pose estimated, reference;
};

/// Each estimated pose with the reference nearest in time; a reference wanted by several goes to the nearest of them.
/// As both paths are ordered by stamp, so are the pairs.
std::vector<Pair> associate(const std::vector<StampedPose>& estimated, const std::vector<StampedPose>& reference,
                            double max_dt_s) {
  std::vector<std::size_t> owner(reference.size(), estimated.size());
  auto dt = [&](std::size_t e, std::size_t r) { return std::abs(estimated[e].stamp_s - reference[r].stamp_s); };
  std::size_t r = 0;
  for (std::size_t e = 0; e < estimated.size() && !reference.empty(); ++e) {
    while (r + 1 < reference.size() && dt(e, r + 1) <= dt(e, r)) ++r;
    if (dt(e, r) > max_dt_s) continue;
    if (owner[r] == estimated.size() || dt(e, r) < dt(owner[r], r)) owner[r] = e;
  }
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < reference.size(); ++i)
    if (owner[i] != estimated.size()) pairs.push_back({estimated[owner[i]].T_map_camera, reference[i].T_map_camera});
  return pairs;
}

void absolute_error(const std::vector<Pair>& pairs, TrajectoryError& error) {
  const auto n = static_cast<Eigen::Index>(pairs.size());
  Eigen::Matrix3Xd estimated(3, n), reference(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    estimated.col(i) = pairs[static_cast<std::size_t>(i)].estimated.translation();
    reference.col(i) = pairs[static_cast<std::size_t>(i)].reference.translation();
  }
  error.T_ref_est.matrix() = Eigen::umeyama(estimated, reference, false);
  double squares = 0, largest = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double square = (error.T_ref_est * estimated.col(i) - reference.col(i)).squaredNorm();
    squares += square;
    largest = std::max(largest, square);
  }
  error.ate_rmse_m = std::sqrt(squares / static_cast<double>(n));
  error.ate_max_m = std::sqrt(largest);
}

void relative_error(const std::vector<Pair>& pairs, std::size_t delta, TrajectoryError& error) {
  double translation = 0, rotation = 0;
  for (std::size_t i = 0; i + delta < pairs.size(); ++i) {
    const Pose step_estimated = pairs[i].estimated.inverse() * pairs[i + delta].estimated;
    const Pose step_reference = pairs[i].reference.inverse() * pairs[i + delta].reference;
    const Pose off = step_reference.inverse() * step_estimated;
    translation += off.translation().squaredNorm();
    rotation += std::pow(rotation_angle(off), 2);
  }
  const auto n = static_cast<double>(pairs.size() - delta);
  error.rpe_trans_rmse_m = std::sqrt(translation / n);
  error.rpe_rot_rmse_deg = std::sqrt(rotation / n) * 180 / std::numbers::pi;
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
