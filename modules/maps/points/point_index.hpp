#pragma once
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "framework/core/parallel.hpp"
#include "modules/maps/points/point_map.hpp"

namespace ppm {

/// The nearest point that was found so far.
struct NearestPoint {
  const SurfacePoint* point = nullptr;
  float square = 0;  ///< m^2 from the query; before anything is found: only what is nearer than this is looked for
};

/// The points of a tile, found by place with a kd-tree. A copy of its own: it outlives the tile.
/// Source: Bentley, "Multidimensional binary search trees", CACM 1975; nanoflann.
class TileIndex {
 public:
  explicit TileIndex(const PointTile& tile);
  ~TileIndex();
  TileIndex(const TileIndex&) = delete;
  TileIndex& operator=(const TileIndex&) = delete;
  /// Takes the nearest point of this tile where it is nearer than `best`, of those whose normal makes a cosine of at least
  /// `cosine` with `normal` (zero: of all). Of equally near ones the first that the tree meets.
  void improve(const Eigen::Vector3f& p, const Eigen::Vector3f& normal, float cosine, NearestPoint& best) const;
  const Eigen::AlignedBox3f& box() const { return box_; }  ///< of the points

 private:
  struct Tree;
  std::vector<SurfacePoint> points_;
  Eigen::AlignedBox3f box_;
  std::unique_ptr<Tree> tree_;
};

/// Finds points of one map. Refers to the map and to the indexes of its tiles.
class PointFinder {
 public:
  PointFinder(const PointMap& map, std::vector<const TileIndex*> tiles) : map_(&map), tiles_(std::move(tiles)) {}
  /// The nearest point within `distance` (m) whose normal agrees, see TileIndex::improve(); null where there is none.
  NearestPoint nearest(const Eigen::Vector3f& p, const Eigen::Vector3f& normal, float distance, float cosine) const;

 private:
  const PointMap* map_;
  std::vector<const TileIndex*> tiles_;  // by tile number; null for an empty one
};

/// The indexes of all tiles of a set of maps, by PointTile::id: maps that share a tile share its index, and it is made once
/// for each content. update() needs the object for itself; of() may be called from any thread in between.
class PointIndexes {
 public:
  /// Makes of() answer for exactly these maps.
  void update(const std::vector<const Map*>& maps, const Workers& workers);
  /// For a map that was given to the last update(), good until the next one.
  PointFinder of(const PointMap& map) const;

  std::size_t size() const { return entries_.size(); }
  std::size_t built() const { return built_; }  ///< by the last update()

 private:
  struct Entry {
    std::unique_ptr<const TileIndex> index;
    std::uint64_t used = 0;  // number of the last update() that asked for it
  };
  std::unordered_map<std::uint64_t, Entry> entries_;
  std::uint64_t updates_ = 0;
  std::size_t built_ = 0;
};

}  // namespace ppm
