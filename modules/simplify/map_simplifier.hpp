#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "framework/roles/map_editor.hpp"
#include "modules/simplify/region.hpp"
#include "modules/simplify/replacement.hpp"

namespace ppm {

/// A surface to be made of fewer triangles.
struct Decimation {
  std::vector<Eigen::Vector3f> position;  ///< [V] m; some may belong to no face
  std::vector<Triangle> face;             ///< counter-clockwise from free space
  std::vector<std::uint8_t> locked;       ///< [V] 1: stays, with all edges to other locked vertices
  float error = 0;                        ///< m, how far the surface may go
};

/// Base of modules that make mature parts of a mesh of fewer faces. What they leave describes the same surface to within
/// a tolerance, whatever decimate() proposes: each proposed face is given its texels and judged; where one does not do,
/// the faces in whose place it would stand are left out and the rest is proposed again. A pure function of the map; a
/// map without due chunks is returned as it is.
class MapSimplifier : public MapEditor {
 public:
  MapHandle edit(Context& context, std::size_t particle, MapHandle map, int worker) final;

 protected:
  MapSimplifier();
  /// Triangles over the same vertices in place of the faces. Any thread.
  virtual std::vector<Triangle> decimate(const Decimation& surface) const = 0;

 private:
  Replacement::Result simplify(const Region& region, const PpmSettings& map) const;

  DueSettings due_;
  ReplacementSettings replacement_;
  double error_base_ = 0.003;
};

}  // namespace ppm
