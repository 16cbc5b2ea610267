#include "modules/maps/points/point_tile.hpp"

#include <algorithm>
#include <atomic>

namespace ppm {

namespace {

std::uint64_t next_id() {
  static std::atomic<std::uint64_t> last{0};
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace

std::span<const SurfacePoint> PointTile::in(std::uint16_t first, std::uint16_t last) const {
  const auto begin = std::ranges::lower_bound(points, first, {}, &SurfacePoint::voxel);
  return {begin, std::ranges::upper_bound(begin, points.end(), last, {}, &SurfacePoint::voxel)};
}

void PointTile::insert(const SurfacePoint& point) {
  points.insert(std::ranges::upper_bound(points, point.voxel, {}, &SurfacePoint::voxel), point);
}

void PointTile::seal() {
  id = next_id();
  box.setEmpty();
  for (const auto& p : points) {
    const Eigen::Vector3f reach = Eigen::Vector3f::Constant(p.radius_m());
    box.extend(p.position - reach).extend(p.position + reach);
  }
  points.shrink_to_fit();
}

std::int64_t PointTile::bytes() const {
  return static_cast<std::int64_t>(sizeof *this + points.capacity() * sizeof(SurfacePoint));
}

}  // namespace ppm
