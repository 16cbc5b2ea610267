#pragma once
#include <cstdint>
#include <vector>

#include "framework/slam/trajectory.hpp"

namespace ppm {

/// Of a sample of errors; the median of an even number is the mean of the middle two.
struct ErrorStatistics {
  double rmse = 0, mean = 0, median = 0, max = 0;
};

/// How far a pose lies from the reference after the alignment of the whole path.
struct PoseError {
  std::int64_t frame = 0;  ///< of the estimated pose
  double stamp_s = 0;      ///< likewise
  double error_m = 0;
};

/// Error of an estimated path against a reference. Source: Sturm et al., IROS 2012, section IV.
struct TrajectoryError {
  int pairs = 0;               ///< poses associated by stamp
  ErrorStatistics ate_m;       ///< absolute trajectory error: translation after rigid alignment (no scale)
  ErrorStatistics rpe_trans_m; ///< relative pose error over `delta` associated poses: translation
  ErrorStatistics rpe_rot_deg; ///< the same: angle of the rotation
  Pose T_ref_est = Pose::Identity();  ///< the alignment: p_ref = T_ref_est * p_est (Umeyama 1991, without scale)
  std::vector<PoseError> poses;       ///< [pairs] what ate_m is of, ascending stamps
};

/// Associates poses by stamp, the nearest two first, each pose once and at most max_dt_s from its partner, and compares.
/// Stamps of each path ascend. delta: associated poses between the two ends of a relative pose. Needs at least 2 pairs
/// (3 that are not in line for a unique alignment; the errors are unique all the same); throws DataError otherwise.
TrajectoryError trajectory_error(const std::vector<StampedPose>& estimated, const std::vector<StampedPose>& reference,
                                 double max_dt_s = 0.02, int delta = 1);

}  // namespace ppm
