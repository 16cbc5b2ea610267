#pragma once
#include <memory>
#include <vector>

#include "modules/maps/points/point_map.hpp"

namespace ppm {

/// The one way to change a point map: takes a handle, changes tiles, and commit() freezes the result as a new map that
/// shares every tile that was not written. Where the handle was the only one its memory is reused. Not thread-safe; one
/// session a map.
class PointEdit {
 public:
  explicit PointEdit(std::shared_ptr<const PointMap> map);

  /// The map as changed so far.
  const PointMap& map() const { return *map_; }
  /// A tile's points for writing, cloned first where another map has them too. Positions and order are the caller's to
  /// keep as PointTile says. Good until the next add().
  std::vector<SurfacePoint>& points(std::uint32_t tile);
  /// A point within `radius` (m, at most the spacing) of a place whose normal agrees to a cosine, or null: the nearest, and the
  /// first found among equals. Good until the next change.
  const SurfacePoint* find(const Eigen::Vector3f& position, const Eigen::Vector3f& normal, float radius, float cosine) const;
  /// Adds a point; its voxel is set here.
  void add(SurfacePoint point);
  /// Removes points: sorted tile by tile, (tile, index in it).
  struct Place {
    std::uint32_t tile, index;
  };
  void remove(const std::vector<Place>& places);

  /// Ends the session.
  std::shared_ptr<const PointMap> commit();

 private:
  PointTile& write(std::uint32_t tile);
  std::shared_ptr<PointMap> map_;
  std::vector<std::uint8_t> written_;  // by tile
};

}  // namespace ppm
