#include "modules/maps/points/point_index.hpp"

#include <nanoflann.hpp>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

/// Points as nanoflann reads them.
struct Places {
  const std::vector<SurfacePoint>* points;
  std::size_t kdtree_get_point_count() const { return points->size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return (*points)[i].position[static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using KdTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Places, float, std::uint32_t>, Places, 3,
                                                   std::uint32_t>;

/// The one nearest point whose normal agrees.
class Agreeing {
 public:
  using DistanceType = float;
  Agreeing(const std::vector<SurfacePoint>& points, const Eigen::Vector3f& normal, float cosine, NearestPoint& best)
      : points_(points), normal_(normal), cosine_(normal.isZero() ? -2.0f : cosine), best_(best) {}
  float worstDist() const { return best_.square; }
  bool full() const { return best_.point != nullptr; }
  /// Always true: the search goes on.
  bool addPoint(float square, std::uint32_t i) {
    if (square < best_.square && (cosine_ < -1 || points_[i].normal.vector().dot(normal_) >= cosine_))
      best_ = {&points_[i], square};
    return true;
  }

 private:
  const std::vector<SurfacePoint>& points_;
  const Eigen::Vector3f& normal_;
  float cosine_;
  NearestPoint& best_;
};

}  // namespace

struct TileIndex::Tree {
  Places places;
  KdTree tree;
  explicit Tree(const std::vector<SurfacePoint>& points)
      : places{&points}, tree(3, places, nanoflann::KDTreeSingleIndexAdaptorParams(8)) {}
};

TileIndex::TileIndex(const PointTile& tile) : points_(tile.points) {
  for (const auto& point : points_) box_.extend(point.position);
  tree_ = std::make_unique<Tree>(points_);
}

TileIndex::~TileIndex() = default;

void TileIndex::improve(const Eigen::Vector3f& p, const Eigen::Vector3f& normal, float cosine, NearestPoint& best) const {
  Agreeing found(points_, normal, cosine, best);
  tree_->tree.findNeighbors(found, p.data(), nanoflann::SearchParams());
}

NearestPoint PointFinder::nearest(const Eigen::Vector3f& p, const Eigen::Vector3f& normal, float distance, float cosine) const {
  NearestPoint best{nullptr, distance * distance};
  // Points stay in the tile that they were made in, and may have moved out of its cell by a little.
  const Eigen::Vector3f reach = Eigen::Vector3f::Constant(distance + static_cast<float>(map_->spacing_m()));
  const Cell low = PointMap::tile_of(map_->voxel_of(p - reach)), high = PointMap::tile_of(map_->voxel_of(p + reach));
  const auto look = [&](const Cell& cell) {
    const auto number = map_->table().find(cell);
    if (number == ChunkTable<PointChunk>::kNone || !tiles_[number]) return;
    if (tiles_[number]->box().squaredExteriorDistance(p) < best.square) tiles_[number]->improve(p, normal, cosine, best);
  };
  const Cell own = PointMap::tile_of(map_->voxel_of(p));
  look(own);  // first: it tells how far the others have to be looked at
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x)
        if (const Cell cell(x, y, z); cell != own) look(cell);
  return best;
}

void PointIndexes::update(const std::vector<const Map*>& maps, const Workers& workers) {
  ++updates_;
  std::vector<std::pair<Entry*, const PointTile*>> missing;
  for (const Map* map : maps)
    for (const auto& chunk : static_cast<const PointMap*>(map)->table().chunks()) {
      if (chunk.tile->points.empty()) continue;
      Entry& entry = entries_[chunk.tile->id];
      if (!entry.index && entry.used != updates_) missing.emplace_back(&entry, chunk.tile.get());
      entry.used = updates_;
    }
  workers.for_each(missing.size(), [&](std::size_t i, int) {
    missing[i].first->index = std::make_unique<const TileIndex>(*missing[i].second);
  });
  built_ = missing.size();
  std::erase_if(entries_, [&](const auto& item) { return item.second.used != updates_; });
}

PointFinder PointIndexes::of(const PointMap& map) const {
  std::vector<const TileIndex*> tiles;
  tiles.reserve(map.table().size());
  for (const auto& chunk : map.table().chunks()) {
    const auto found = entries_.find(chunk.tile->id);
    PPM_CHECK(chunk.tile->points.empty() || found != entries_.end(), "a map is searched that was not prepared");
    tiles.push_back(chunk.tile->points.empty() ? nullptr : found->second.index.get());
  }
  return {map, std::move(tiles)};
}

}  // namespace ppm
