#pragma once
#include <span>

#include "modules/prediction/raster_kernels.hpp"

namespace ppm {

/// What a band shows at some of its pixels: up to RasterPixels::kMost at a time. Large: make one and use it often.
class RasterLookup {
 public:
  /// linear_texels: interpolate between texels; otherwise take the nearest.
  RasterLookup(const RasterCamera& camera, bool linear_texels) : camera_(camera), linear_texels_(linear_texels) {}

  /// Looks up pixels (indices into the view, ascending, all in the band, at least one).
  void find(const RasterBand& band, std::span<const std::uint32_t> pixels);

  /// The face that a pixel shows.
  struct Element {
    const RasterTexels* texels = nullptr;  ///< of its chunk; null: a miss
    std::uint32_t face = 0;
    float side = 1;                                    ///< -1: seen from behind
    float added_variance = 0;                          ///< m^2, of the face
    const float *mean = nullptr, *variance = nullptr;  ///< the face's texels
  };
  Element element[RasterPixels::kMost];
  /// Range, cosine and barycentrics; where nothing is shown they are some finite numbers.
  RasterPixels at;
  RasterPixels::Lanes<float> mean;      ///< m along the normal, turned to the camera
  RasterPixels::Lanes<float> variance;  ///< m^2 along the normal

 private:
  void gather(const RasterBand& band, std::span<const std::uint32_t> pixels);
  void take(const RasterBand& band, std::size_t i, std::uint32_t triangle);
  void read_texels();

  const RasterCamera& camera_;
  bool linear_texels_;
};

}  // namespace ppm
