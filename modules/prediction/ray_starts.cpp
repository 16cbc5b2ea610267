#include "modules/prediction/ray_starts.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace ppm {

void RayStarts::build(const VdbMap& map, const Camera& camera, const Pose& T_map_camera) {
  blocks_x_ = (camera.cols + kBlock - 1) / kBlock;
  blocks_y_ = (camera.rows + kBlock - 1) / kBlock;
  start_.assign(static_cast<std::size_t>(blocks_x_ * blocks_y_), std::numeric_limits<float>::infinity());
  const Eigen::Matrix3f R = T_map_camera.linear().transpose().cast<float>();
  const Eigen::Vector3f eye = (T_map_camera.translation() / map.settings().voxel_size_m).cast<float>();
  constexpr float half = 0.5f * kVdbLeafEdge;
  for (std::size_t i = 0; i < map.table().size(); ++i) {
    const VdbChunk& chunk = map.table()[i];
    if (!chunk.tile && chunk.constant <= 0) continue;
    const Cell low = map.table().cell(i) * kVdbTileEdge;
    for (int n = 0; n < kVdbTileLeaves; ++n) {
      if (chunk.tile && !chunk.tile->occupied(n)) continue;
      const Cell leaf = low + VdbTile::offset(n);
      add(camera, R * (leaf.cast<float>() + Eigen::Vector3f::Constant(half) - eye));
    }
  }
}

// The leaf's sphere, in a box along the camera's axes: a little more than the leaf shows.
void RayStarts::add(const Camera& camera, const Eigen::Vector3f& centre) {
  constexpr float radius = 0.8661f * kVdbLeafEdge, kNear = 1;  // voxels
  const float far = centre.z() + radius, near = centre.z() - radius;
  if (far <= 0) return;
  const float range = std::max(centre.norm() - radius, 0.0f);
  int x0 = 0, x1 = blocks_x_ - 1, y0 = 0, y1 = blocks_y_ - 1;
  if (near > kNear) {
    auto blocks = [&](float low, float high, double f, double c, int most) {
      auto a = static_cast<float>(f) * (low < 0 ? low / near : low / far);
      auto b = static_cast<float>(f) * (high < 0 ? high / far : high / near);
      if (b < a) std::swap(a, b);
      const auto middle = static_cast<float>(c) + 0.5f, last = static_cast<float>(most * kBlock + kBlock - 1);
      return std::pair(static_cast<int>(std::clamp(a + middle - 1, -1.0f, last + kBlock)),
                       static_cast<int>(std::clamp(b + middle + 1, -1.0f, last + kBlock)));
    };
    const auto [left, right] = blocks(centre.x() - radius, centre.x() + radius, camera.fx, camera.cx, x1);
    const auto [top, bottom] = blocks(centre.y() - radius, centre.y() + radius, camera.fy, camera.cy, y1);
    if (right < 0 || bottom < 0) return;
    x0 = std::max(left, 0) / kBlock, x1 = std::min(right / kBlock, x1);
    y0 = std::max(top, 0) / kBlock, y1 = std::min(bottom / kBlock, y1);
  }
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      float& start = start_[static_cast<std::size_t>(y * blocks_x_ + x)];
      start = std::min(start, range);
    }
}

}  // namespace ppm
