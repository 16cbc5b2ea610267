#pragma once
#include <cstddef>
#include <cstdint>

#include "modules/prediction/raster_band.hpp"

namespace ppm {

/// A camera as the rasterizer's kernels see it. A point p of the map has the image coordinates (x/w, y/w), counted from
/// the camera's middle pixel, where (x, y, w) = axes * (p - centre); w is its depth.
/// Kernels run on the best instructions that the processor has, and give the same bytes on all.
struct RasterCamera {
  float axes[3][3];
  float centre[3], centre_rest[3];             ///< m, map frame: their sum, to more than a float's precision
  float ray_x, ray_y;                          ///< 1/fx, 1/fy, to make rays of image coordinates:
  float ray_x0, ray_y0;                        ///< ray = (ray_x x + ray_x0, ray_y y + ray_y0, 1)
  float focal_x, focal_y, offset_x, offset_y;  ///< x = focal_x x_camera + offset_x z_camera
  float front;                                 ///< +-1: sign of det(v0, v1, v2) of a face that is seen from its front
  bool cull;                                   ///< faces seen from behind are not drawn
  int middle_x, middle_y;                      ///< px
  int cols, rows, first_row, end_row;          ///< the image, and the rows of it that are drawn
  int fraction_bits;  ///< image coordinates of vertices are rounded to 2^-fraction_bits px for boxes
};

/// Faces of a chunk that may cover a pixel's centre, and the pixels where: columns and rows, first | last << 16.
struct RasterBoxes {
  AlignedArray<std::uint32_t> face, columns, rows;
  std::size_t size = 0;
};

/// vertex: [count*4] x, y, w (see RasterCamera), and x/w, y/w rounded for boxes, as an integer in a float's place.
/// position: [count*3] m, map frame.
void raster_project(const RasterCamera& camera, const float* position, std::size_t count, float* vertex);

/// Appends the faces first .. end-1 that may cover pixels to `boxes`, which has room for them and kSpare. face:
/// [faces*3] vertices.
void raster_select(const RasterCamera& camera, const std::uint32_t* face, std::size_t faces, std::size_t first,
                   std::size_t end, const float* vertex, RasterBoxes& boxes);

/// Draws the faces of `boxes` into the band: where they are in front of what is shown, or at the same depth and of a
/// lower chunk or face. slot: of their chunk. inverse_depth: [rows*cols + kSpare] of what is shown, 1/m; 0 = nothing.
void raster_draw(const RasterCamera& camera, const std::uint32_t* face, const float* vertex, const RasterBoxes& boxes,
                 std::uint32_t slot, RasterBand& band, float* inverse_depth);

/// Pixels of a view that attributes are looked up for: arrays of one entry a pixel.
struct RasterPixels {
  static constexpr std::size_t kMost = 256;
  template <class T>
  struct alignas(64) Lanes {
    T value[kMost];
    T& operator[](std::size_t i) { return value[i]; }
    const T& operator[](std::size_t i) const { return value[i]; }
  };
  std::size_t size = 0;
  alignas(64) float quad[3][4 * kMost];  ///< [kMost][4] each, see RasterBand
  Lanes<float> x, y;                     ///< image coordinates
  Lanes<std::int32_t> divisions;
  // raster_locate:
  Lanes<float> range, cosine;  ///< m along the ray; |normal . ray|
  Lanes<float> u, v;
  Lanes<std::int32_t> texel[3];  ///< positions within the face's texels, and their weights
  Lanes<float> weight[3];
};

/// Finds range, cosine, barycentrics and texels of pixels from quads, x, y and divisions. linear: all three texels
/// around; otherwise the nearest has all the weight.
void raster_locate(const RasterCamera& camera, bool linear, RasterPixels& pixels);

}  // namespace ppm
