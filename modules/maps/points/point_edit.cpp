#include "modules/maps/points/point_edit.hpp"

#include <algorithm>

#include "framework/core/error.hpp"
#include "framework/core/only_handle.hpp"

namespace ppm {

PointEdit::PointEdit(std::shared_ptr<const PointMap> map) {
  PPM_CHECK(map != nullptr, "an edit needs a map");
  map_ = is_only_handle(map) ? std::const_pointer_cast<PointMap>(std::move(map)) : std::make_shared<PointMap>(*map);
  written_.assign(map_->table().size(), 0);
}

PointTile& PointEdit::write(std::uint32_t tile) {
  written_[tile] = 1;
  return map_->table_.edit(tile).tile.write();
}

std::vector<SurfacePoint>& PointEdit::points(std::uint32_t tile) {
  PPM_CHECK(tile < map_->table().size(), "tile {} of {}", tile, map_->table().size());
  return write(tile).points;
}

const SurfacePoint* PointEdit::find(const Eigen::Vector3f& position, const Eigen::Vector3f& normal, float radius,
                                    float cosine) const {
  const SurfacePoint* nearest = nullptr;
  float least = radius * radius;
  const Cell low = map_->voxel_of(position - Eigen::Vector3f::Constant(radius));
  const Cell high = map_->voxel_of(position + Eigen::Vector3f::Constant(radius));
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x();) {
        const Cell tile = PointMap::tile_of({x, y, z});
        const Cell in = Cell(x, y, z) - PointTile::kVoxels * tile;
        const int run = std::min(high.x() - x, PointTile::kVoxels - 1 - in.x());  // voxels of this tile that follow
        x += run + 1;
        const auto number = map_->table().find(tile);
        if (number == ChunkTable<PointChunk>::kNone) continue;
        for (const auto& point : map_->table()[number].tile->in(PointTile::voxel(in.x(), in.y(), in.z()),
                                                                PointTile::voxel(in.x() + run, in.y(), in.z()))) {
          const float square = (point.position - position).squaredNorm();
          if (!(square < least) || point.normal.vector().dot(normal) < cosine) continue;
          least = square;
          nearest = &point;
        }
      }
  return nearest;
}

void PointEdit::add(SurfacePoint point) {
  const Cell voxel = map_->voxel_of(point.position), cell = PointMap::tile_of(voxel);
  const Cell in = voxel - PointTile::kVoxels * cell;
  point.voxel = PointTile::voxel(in.x(), in.y(), in.z());
  auto tile = map_->table().find(cell);
  if (tile == ChunkTable<PointChunk>::kNone) {
    tile = map_->table_.add(cell, {Cow<PointTile>::make()});
    written_.push_back(1);
  }
  write(tile).insert(point);
}

void PointEdit::remove(const std::vector<Place>& places) {
  for (auto first = places.begin(); first != places.end();) {
    const auto last = std::find_if(first, places.end(), [&](const Place& p) { return p.tile != first->tile; });
    auto& points = write(first->tile).points;
    std::size_t kept = first->index;
    auto gone = first;
    for (std::size_t i = kept; i < points.size(); ++i) {
      if (gone != last && gone->index == i)
        ++gone;
      else
        points[kept++] = points[i];
    }
    points.resize(kept);
    first = last;
  }
}

std::shared_ptr<const PointMap> PointEdit::commit() {
  for (std::size_t tile = 0; tile < written_.size(); ++tile)
    if (written_[tile]) map_->table_.edit(tile).tile.write().seal();
  map_->table_.shrink_to_fit();
  return std::move(map_);
}

}  // namespace ppm
