#pragma once
#include <cstddef>
#include <cstdint>

namespace ppm {

/// A view as a plane for each pixel (x, y), row-major: of the described surface, as inverse depth over the image, 1/z = disparity + per_x (x' - x) + per_y (y' - y). Where nothing is shown
/// the distance is 0, and the disparity that of the surface beside.
struct PlaneArrays {
  int cols, rows;
  const float *disparity, *per_x, *per_y;  // 1/m at the pixel, and per pixel
  const float* distance;                   // m: of the plane from the camera's centre
  const float* variance;                   // m^2 along the normal
};

/// From a pixel of one camera to pixels of another that is near: the point at inverse depth w on the ray of (x, y) is
/// seen at turn (x, y, 1) + w shift, in homogeneous coordinates of pixels.
struct Warp {
  float turn[9];  // row-major
  float shift[3];
  int cols;                    // of the camera that is predicted
  float fx, fy, cx, cy;  // px
};

/// What the camera sees at some pixels, as in ViewSamples, and at which pixel of the planes' view it was found. Arrays
/// of n. The same bytes on every processor.
void warp_samples(const PlaneArrays& planes, const Warp& warp, const std::uint32_t* pixels, std::size_t n,
                  float least_cosine, float* range, float* variance, float* cosine, std::uint32_t* found);

}  // namespace ppm
