#include "modules/maps/vdb/visible_tiles.hpp"

#include <cmath>
#include <limits>

namespace ppm {
namespace {

constexpr int kRootTiles = 16;  // tiles along the edge of the cubes to begin with

enum class Seen { nothing, free, no_hits, mixed };

class Search {
 public:
  Search(const PixelProfiles& profiles, const DepthBounds& bounds, const Pose& T_map_camera, double voxel_size_m)
      : camera_(profiles.camera),
        bounds_(bounds),
        T_map_camera_(T_map_camera),
        T_camera_map_(T_map_camera.inverse()),
        depth_row_(T_camera_map_.linear().row(2).cwiseAbs().sum()),
        h_(voxel_size_m) {}

  std::vector<SeenTile> run() {
    const float deepest = bounds_.of({0, 0, camera_.cols - 1, camera_.rows - 1}).end;
    if (!(deepest > 0)) return {};
    const auto [low, high] = reach(deepest);
    for (int x = low.x(); x <= high.x(); ++x)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int z = low.z(); z <= high.z(); ++z) descend(Cell(x, y, z) * kRootTiles, kRootTiles);
    return std::move(seen_);
  }

 private:
  /// The first and the last cube to begin with that the view reaches into.
  std::pair<Cell, Cell> reach(double deepest) const {
    Eigen::AlignedBox3d box(T_map_camera_.translation());
    for (double x : {-0.5, camera_.cols - 0.5})
      for (double y : {-0.5, camera_.rows - 0.5}) box.extend(T_map_camera_ * (deepest * camera_.ray(x, y)));
    const double edge = h_ * kVdbTileEdge * kRootTiles;
    return {(box.min() / edge).array().floor().cast<int>(), (box.max() / edge).array().floor().cast<int>()};
  }

  /// tiles: along the cube's edge; cell: of its lowest tile.
  void descend(const Cell& cell, int tiles) {
    const Seen seen = look(cell * kVdbTileEdge, tiles * kVdbTileEdge);
    if (seen == Seen::nothing) return;
    if (seen == Seen::free) return add_free(cell, tiles);
    if (tiles == 1) return add_leaves(cell);
    for (int octant = 0; octant < 8; ++octant)
      descend(cell + Cell(octant >> 2, (octant >> 1) & 1, octant & 1) * (tiles / 2), tiles / 2);
  }
  void add_free(const Cell& cell, int tiles) {
    for (int x = 0; x < tiles; ++x)
      for (int y = 0; y < tiles; ++y)
        for (int z = 0; z < tiles; ++z) seen_.push_back({cell + Cell(x, y, z), kAllLeaves, 0, 0});
  }
  void add_leaves(const Cell& cell) {
    SeenTile tile{cell};
    for (int x = 0; x < kVdbTileEdge; x += kVdbLeafEdge)
      for (int y = 0; y < kVdbTileEdge; y += kVdbLeafEdge)
        for (int z = 0; z < kVdbTileEdge; z += kVdbLeafEdge) {
          const auto bit = static_cast<std::uint8_t>(1u << vdb_leaf(x, y, z));
          const Seen seen = look(cell * kVdbTileEdge + Cell(x, y, z), kVdbLeafEdge);
          if (seen == Seen::free) tile.free |= bit;
          if (seen == Seen::no_hits || seen == Seen::mixed) tile.mixed |= bit;
          if (seen == Seen::no_hits) tile.no_hits |= bit;
        }
    if (tile.free || tile.mixed) seen_.push_back(tile);
  }

  /// What the image says about a cube of voxels: that is, about their centres.
  Seen look(const Cell& lowest, int edge) const {
    const double half = 0.5 * (edge - 1) * h_;
    const Eigen::Vector3d centre = T_camera_map_ * ((lowest.cast<double>().array() + 0.5 * edge) * h_).matrix();
    const double reach = half * depth_row_;
    const double nearest = centre.z() - reach, deepest = centre.z() + reach;
    if (deepest <= 0) return Seen::nothing;
    PixelRect rect{0, 0, camera_.cols - 1, camera_.rows - 1};
    bool inside = false;
    if (nearest > 1e-3) {
      const PixelRect whole = footprint(centre, half);
      rect = {std::max(whole.x0, 0), std::max(whole.y0, 0), std::min(whole.x1, camera_.cols - 1),
              std::min(whole.y1, camera_.rows - 1)};
      if (rect.x0 > rect.x1 || rect.y0 > rect.y1) return Seen::nothing;
      inside = rect.x0 == whole.x0 && rect.y0 == whole.y0 && rect.x1 == whole.x1 && rect.y1 == whole.y1;
    }
    const auto bounds = bounds_.of(rect);
    if (nearest > bounds.end) return Seen::nothing;
    if (inside && deepest <= bounds.free) return Seen::free;
    return deepest <= bounds.measured_free ? Seen::no_hits : Seen::mixed;
  }

  /// The pixels that a cube may fall on, which lies before the camera.
  PixelRect footprint(const Eigen::Vector3d& centre, double half) const {
    constexpr double kSlack = 0.5 + 1e-3;  // to the nearest pixel, and the rounding of those who look voxel by voxel
    constexpr double kMost = 1e6;
    const Eigen::Matrix3d axes = half * T_camera_map_.linear();
    Eigen::Array2d low(kMost, kMost), high(-kMost, -kMost);
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d p = centre + (corner & 1 ? 1 : -1) * axes.col(0) + (corner & 2 ? 1 : -1) * axes.col(1) +
                                (corner & 4 ? 1 : -1) * axes.col(2);
      const Eigen::Array2d at = camera_.project(p).array();
      low = low.min(at);
      high = high.max(at);
    }
    const auto to_int = [&](double v) { return static_cast<int>(std::floor(std::clamp(v, -kMost, kMost))); };
    return {to_int(low.x() + 1 - kSlack), to_int(low.y() + 1 - kSlack), to_int(high.x() + kSlack),
            to_int(high.y() + kSlack)};
  }

  const Camera& camera_;
  const DepthBounds& bounds_;
  Pose T_map_camera_, T_camera_map_;
  double depth_row_;
  double h_;
  std::vector<SeenTile> seen_;
};

}  // namespace

std::vector<SeenTile> seen_tiles(const PixelProfiles& profiles, const DepthBounds& bounds, const Pose& T_map_camera,
                                 double voxel_size_m) {
  return Search(profiles, bounds, T_map_camera, voxel_size_m).run();
}

}  // namespace ppm
