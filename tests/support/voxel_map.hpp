#pragma once
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "modules/maps/vdb/vdb_edit.hpp"

namespace ppm::test {

/// Log odds at a point of the map frame, m; nothing where it is unknown.
using LogOddsAt = std::function<std::optional<float>(const Eigen::Vector3d&)>;

/// The grid whose voxels from `low` to `high` (m, rounded outwards to whole tiles) have the log odds at their centres.
inline std::shared_ptr<const VdbMap> voxel_map(const VdbSettings& settings, const Eigen::Vector3d& low,
                                               const Eigen::Vector3d& high, const LogOddsAt& log_odds) {
  VdbEdit edit(std::make_shared<const VdbMap>(settings));
  const Cell first = VdbMap::cell_of(edit.map().voxel_of(low)), last = VdbMap::cell_of(edit.map().voxel_of(high));
  for (int x = first.x(); x <= last.x(); ++x)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int z = first.z(); z <= last.z(); ++z) {
        const auto chunk = edit.chunk({x, y, z});
        VdbTile& tile = edit.tile(chunk);
        for (int n = 0; n < kVdbTileLeaves; ++n) {
          VdbCode* codes = tile.write(n);
          const Cell leaf = Cell(x, y, z) * kVdbTileEdge + Cell(n >> 2 & 1, n >> 1 & 1, n & 1) * kVdbLeafEdge;
          for (int v = 0; v < kVdbLeafVoxels; ++v) {
            const Cell voxel = leaf + Cell(v >> 6, v >> 3 & 7, v & 7);
            const auto value = log_odds(settings.voxel_size_m * (voxel.cast<double>() + Eigen::Vector3d::Constant(0.5)));
            codes[v] = value ? edit.map().code(*value) : kVdbUnknown;
          }
          tile.settle(n);
        }
        edit.settle(chunk);
      }
  return edit.commit();
}

/// Log odds of a surface at signed distance 0 (m, negative in front of it): `slope` (1/m) times the distance; unknown
/// farther than `known_behind` behind it.
inline std::optional<float> surface_log_odds(double distance, double slope, double known_behind) {
  if (distance > known_behind) return std::nullopt;
  return static_cast<float>(slope * distance);
}

/// Signed distance inside an axis-aligned box seen from within: negative inside.
inline double box_distance(const Eigen::Vector3d& p, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return (low - p).cwiseMax(p - high).maxCoeff();
}

}  // namespace ppm::test
