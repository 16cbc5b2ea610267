#pragma once
#include "modules/maps/ppm/chunk.hpp"
#include "modules/maps/ppm/node_fusion.hpp"

namespace ppm {

/// A vertex of an exported mesh while texels are added to it.
struct MeshNode {
  OffsetFusion offset;
  ColorFusion color;  ///< unused in maps without colour
};

/// Red, green, blue of a texel that has one channel (intensity) or three.
inline Eigen::Vector3f texel_color(const TexelView& texels, std::size_t t) {
  if (texels.color.size() == texels.mean.size()) return Eigen::Vector3f::Constant(texels.color[t]);
  return {texels.color[3 * t], texels.color[3 * t + 1], texels.color[3 * t + 2]};
}

/// The texels of one face, as they count in the surface that the map describes: the variance holds the face's own excess.
class FaceTexels {
 public:
  FaceTexels(const PpmChunk& chunk, std::uint32_t face);

  /// Adds texel (i, j) to a node. normal: unit, along which the node moves.
  void add(std::uint32_t i, std::uint32_t j, const Eigen::Vector3f& normal, MeshNode& node) const;
  /// Adds what lies at the share s of side k (from corner k to the next), linear between two texels.
  void add_on_side(std::uint32_t k, double s, const Eigen::Vector3f& normal, MeshNode& node) const;

 private:
  std::uint32_t on_side(std::uint32_t k, std::uint32_t s) const;
  std::uint32_t n_;
  TexelView texels_;
  double added_variance_;
  Eigen::Vector3f normal_;
};

}  // namespace ppm
