#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "modules/maps/points/measured_points.hpp"
#include "modules/maps/points/point_map.hpp"

namespace ppm {

/// What one frame says of a point.
struct PointTally {
  float weight = 0;   ///< 1/m^2: of the measurements' distances from the disc along its normal, summed
  float shift = 0;    ///< 1/m: weight times distance, summed
  float surplus = 0;  ///< m^2: squared distances minus what sensor and point account for, summed
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();       ///< of the measured normals that agree, summed
  float radius = std::numeric_limits<float>::infinity();  ///< m: the least that a measurement asks for
  std::uint32_t measured = 0;  ///< pixels that measured the disc
  std::uint32_t hits = 0, through = 0;  ///< pixels that did, and that saw behind it, not at grazing incidence
};

/// A measurement that may become a point.
struct PointCandidate {
  MeasuredPoint at;
  Eigen::Vector3f normal;  ///< unit, towards the camera
};

/// What a frame says of a map.
struct PointTallies {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> first;  ///< by tile: of its points in `tally`; kNone where no pixel shows one
  std::vector<std::uint32_t> tiles;  ///< those that pixels show
  std::vector<PointTally> tally;
  std::vector<PointCandidate> candidates;  ///< in the order of pixels

  void reset(std::size_t map_tiles) {
    first.assign(map_tiles, kNone);
    tiles.clear();
    tally.clear();
    candidates.clear();
  }
  PointTally& of(const PointMap& map, std::uint32_t tile, std::uint32_t index) {
    if (first[tile] == kNone) {
      first[tile] = static_cast<std::uint32_t>(tally.size());
      tally.resize(tally.size() + map.table()[tile].tile->points.size());
      tiles.push_back(tile);
    }
    return tally[first[tile] + index];
  }
};

}  // namespace ppm
