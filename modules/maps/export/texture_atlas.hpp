#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "modules/maps/ppm/texel_grid.hpp"
#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

/// Where the texels of faces lie in one image: texel (i, j) of a face in pixel first + step * (i, j), and around them a
/// gutter of one pixel, so that bilinear filtering takes nothing from other faces. Two faces share a rectangle, one of
/// them turned by half a turn; rectangles stand in rows.
class TextureAtlas {
 public:
  /// divisions: [F] of the faces.
  explicit TextureAtlas(std::span<const std::uint8_t> divisions);
  int cols() const { return cols_; }
  int rows() const { return rows_; }
  /// The texture coordinates of a face's corners: [0, 1], v downwards as in glTF.
  std::array<Eigen::Vector2f, 3> uv(std::size_t face) const;
  /// An image in which each texel and its gutter are painted. texel: [T] colours, face after face in the order of
  /// texel_index. Bilinear filtering inside a face mixes only its own texels.
  RgbImage paint(std::span<const Color> texel) const;

 private:
  struct Place {
    int x = 0, y = 0, step = 1;
    std::uint32_t first_texel = 0;
    int divisions = 1;
  };
  void pack(std::span<const std::uint8_t> divisions);
  std::vector<Place> places_;
  int cols_ = 1, rows_ = 1;
};

}  // namespace ppm
