#pragma once
#include <optional>
#include <vector>

#include "framework/slam/trajectory.hpp"

namespace ppm {

/// Error of an estimated path against a reference. Source: Sturm et al., IROS 2012, section IV.
struct TrajectoryError {
  int pairs = 0;                ///< poses associated by stamp
  double ate_rmse_m = 0;        ///< absolute trajectory error after rigid alignment (no scale), RMSE of translation
  double ate_max_m = 0;
  double rpe_trans_rmse_m = 0;  ///< relative pose error over `delta` associated poses, RMSE of translation
  double rpe_rot_rmse_deg = 0;
  Pose T_ref_est = Pose::Identity();  ///< the alignment: p_ref = T_ref_est * p_est (Horn/Umeyama, without scale)
};

/// Associates each estimated pose with the reference pose nearest in time (at most max_dt_s away, each used once, in order)
/// and compares. delta: poses between the two ends of a relative pose. Needs at least 2 pairs (3 for a unique alignment);
/// throws DataError otherwise.
TrajectoryError trajectory_error(const std::vector<StampedPose>& estimated, const std::vector<StampedPose>& reference,
                                 double max_dt_s = 0.02, int delta = 1);

}  // namespace ppm
