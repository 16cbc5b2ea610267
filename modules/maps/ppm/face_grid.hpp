#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// The faces of a map by small cubic cells, for questions about a finished map: rays at any place and of any length,
/// without an acceleration structure of its own kind. Made for one map, which must outlive it.
class FaceGrid {
 public:
  struct Hit {
    double range = 0;        ///< m along the ray
    Eigen::Vector3f normal;  ///< of the face, unit
    std::uint32_t chunk = 0;
    std::uint32_t face = 0;
  };

  explicit FaceGrid(const PpmMap& map, double cell_m = 0.1);
  /// The nearest face that the ray meets from its observed side at a range in (from, to), m. direction: unit.
  std::optional<Hit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double from,
                               double to) const;

 private:
  struct Corners {
    Eigen::Vector3d origin, edge1, edge2;
    std::uint32_t chunk, face;
  };
  void insert(std::uint32_t number, const Corners& corners);
  Cell cell_of(const Eigen::Vector3d& p) const;

  double cell_m_;
  std::vector<Corners> faces_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
  Eigen::AlignedBox3d box_;
};

}  // namespace ppm
