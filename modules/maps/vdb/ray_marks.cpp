#include "modules/maps/vdb/ray_marks.hpp"

#include <cmath>
#include <limits>

namespace ppm {
namespace {

Cell floor_of(const Eigen::Vector3d& p) { return p.array().floor().cast<int>(); }

std::size_t bit_of(const Cell& v) {
  return static_cast<std::size_t>(vdb_leaf(v.x(), v.y(), v.z()) * kVdbLeafVoxels + vdb_voxel(v.x(), v.y(), v.z()));
}

}  // namespace

std::vector<RayEnd> ray_ends(const Frame& frame, double max_range_m) {
  std::vector<RayEnd> ends;
  for (int y = 0, i = 0; y < frame.camera.rows; ++y)
    for (int x = 0; x < frame.camera.cols; ++x, ++i) {
      if (!frame.valid(i)) continue;
      const Eigen::Vector3d p = frame.depth[static_cast<std::size_t>(i)] * frame.camera.ray(x, y);
      const bool hit = p.norm() <= max_range_m;
      ends.push_back({hit ? p : Eigen::Vector3d(max_range_m * p.normalized()), hit});
    }
  return ends;
}

RayMarks::RayMarks(const std::vector<RayEnd>& ends, const Pose& T_map_camera, double voxel_size_m) {
  const Eigen::Vector3d from = T_map_camera.translation() / voxel_size_m;
  for (const auto& end : ends) follow(from, T_map_camera * end.p_camera / voxel_size_m, end.hit);
}

RayMarks::Tile& RayMarks::tile_of(const Cell& voxel) {
  const Cell cell = VdbMap::cell_of(voxel);
  if (!tiles_.empty() && tiles_[last_].cell == cell) return tiles_[last_];
  const auto [it, added] = number_.try_emplace(cell, tiles_.size());
  if (added) tiles_.push_back({cell, {}, {}});
  last_ = it->second;
  return tiles_[last_];
}

// In units of voxels. Each axis takes as many steps as there are voxels between the ends, so that rounding never leads
// past the last one.
void RayMarks::follow(const Eigen::Vector3d& from, const Eigen::Vector3d& to, bool hit) {
  Cell at = floor_of(from);
  const Cell last = floor_of(to);
  const Eigen::Vector3d way = to - from;
  Cell left = (last - at).cwiseAbs();
  const Cell sign = (last - at).cwiseSign();
  Eigen::Vector3d next;  // share of the way at which an axis takes its next step
  for (int k = 0; k < 3; ++k)
    next[k] = left[k] > 0 ? (at[k] + (sign[k] > 0) - from[k]) / way[k] : std::numeric_limits<double>::infinity();
  for (int steps = left.sum(); steps > 0; --steps) {
    tile_of(at).passed.set(bit_of(at));
    int k = 0;
    next.minCoeff(&k);
    at[k] += sign[k];
    next[k] = --left[k] > 0 ? next[k] + std::abs(1 / way[k]) : std::numeric_limits<double>::infinity();
  }
  if (hit) tile_of(last).hit.set(bit_of(last));
}

}  // namespace ppm
