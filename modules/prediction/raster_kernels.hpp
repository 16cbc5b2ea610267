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

/// Consecutive pixels of a list that show the same triangle, and what is known of it: arrays by run.
struct RasterRuns {
  static constexpr std::size_t kMost = 512;  ///< runs, and pixels
  static constexpr std::size_t kRoom = kMost + RasterBand::kSpare;
  std::size_t size = 0;
  alignas(64) std::uint32_t triangle[kRoom];
  alignas(64) float quad[3][4 * kRoom];  ///< [kRoom][4] each, see RasterBand
  alignas(64) float divisions[kRoom];
  /// Of the face's first texel, from where mean_base and variance_base point to.
  alignas(64) std::int32_t mean[kRoom], variance[kRoom];
  alignas(64) float added_variance[kRoom];  ///< m^2, of the face; negative: a miss
  const float *mean_base = nullptr, *variance_base = nullptr;
  /// Made by raster_look_up: the quads' members, [12][kRoom].
  alignas(64) float member[12][kRoom];
};

/// What pixels show, by pixel of a list.
struct RasterPixels {
  std::size_t size = 0;
  alignas(64) std::int32_t run[RasterRuns::kRoom];  ///< rises by 0 or 1 from pixel to pixel
  /// Index into the band. The first stands also before the first, and the last kSpare times after the last.
  std::int32_t* pixel() { return pixel_room_ + RasterBand::kSpare; }
  const std::int32_t* pixel() const { return pixel_room_ + RasterBand::kSpare; }
  // Made by raster_look_up; where nothing is shown, u, v and mean are some finite numbers.
  alignas(64) float u[RasterRuns::kRoom], v[RasterRuns::kRoom];
  alignas(64) float range[RasterRuns::kRoom], mean[RasterRuns::kRoom], variance[RasterRuns::kRoom];
  alignas(64) float cosine[RasterRuns::kRoom];
  alignas(64) std::int32_t texel[3][RasterRuns::kRoom];  ///< around, within the face's texels, and their weights
  alignas(64) float weight[3][RasterRuns::kRoom];

 private:
  alignas(64) std::int32_t pixel_room_[RasterBand::kSpare + RasterRuns::kRoom];
};

/// Finds the runs of pixels that show the same triangle: runs.triangle, runs.size, pixels.run. shown: of a band.
void raster_split(const std::uint32_t* shown, RasterRuns& runs, RasterPixels& pixels);

/// What a lookup is to say.
struct RasterQuestion {
  bool linear_texels = true;  ///< texels interpolated; otherwise the nearest
  /// Range and variance of the described surface along the ray, and the cosine (see ViewSamples); otherwise range of
  /// the face, mean and variance along the normal, which is turned to the camera (see Prediction).
  bool along_ray = true;
  float least_cosine = 0;  ///< that is divided by
  float miss = 0;          ///< the range where nothing is shown
};

/// Finds what the pixels show. The arrays of `runs` and `pixels` may be written up to their room.
void raster_look_up(const RasterCamera& camera, const RasterQuestion& question, RasterRuns& runs, RasterPixels& pixels);

}  // namespace ppm
