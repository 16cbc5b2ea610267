#include "modules/sources/pose_lookup.hpp"

#include <algorithm>

namespace ppm {

std::optional<Pose> pose_at(const std::vector<StampedPose>& path, double stamp_s, double max_dt_s) {
  const auto after =
      std::lower_bound(path.begin(), path.end(), stamp_s, [](const StampedPose& p, double s) { return p.stamp_s < s; });
  const bool has_after = after != path.end() && after->stamp_s - stamp_s <= max_dt_s;
  const bool has_before = after != path.begin() && stamp_s - (after - 1)->stamp_s <= max_dt_s;
  if (has_before && has_after) {
    const StampedPose& before = *(after - 1);
    return interpolate(before.T_map_camera, after->T_map_camera,
                       (stamp_s - before.stamp_s) / (after->stamp_s - before.stamp_s));
  }
  if (has_after) return after->T_map_camera;
  if (has_before) return (after - 1)->T_map_camera;
  return std::nullopt;
}

}  // namespace ppm
