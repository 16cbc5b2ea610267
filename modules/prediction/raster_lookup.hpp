#pragma once
#include <span>

#include "modules/prediction/raster_kernels.hpp"

namespace ppm {

/// What a band shows at some of its pixels: up to RasterRuns::kMost at a time. Large: make one and use it often.
class RasterLookup {
 public:
  RasterLookup(const RasterCamera& camera, const RasterQuestion& question) : camera_(camera), question_(question) {}

  /// Looks up the first of some pixels (indices into the view, ascending, all in the band), at least one; says how
  /// many.
  std::size_t find(const RasterBand& band, std::span<const std::uint32_t> pixels);

  /// A face that pixels show.
  struct Face {
    const RasterTexels* texels = nullptr;  ///< of its chunk; null: a miss
    std::uint32_t face = 0;
    float side = 1;  ///< -1: seen from behind
  };
  const Face& face(std::size_t i) const { return face_[at.run[i]]; }
  RasterPixels at;

 private:
  void take(const RasterBand& band, std::span<const std::uint32_t> pixels);
  void copy_triangles(const RasterBand& band);
  std::size_t read_faces();

  RasterCamera camera_;
  RasterQuestion question_;
  RasterRuns runs_;
  Face face_[RasterRuns::kMost];
};

}  // namespace ppm
