#pragma once
#include <cstddef>

#include "framework/config/params.hpp"
#include "framework/slam/pixel_block.hpp"
#include "modules/weighting/range_kernels.hpp"

namespace ppm {

/// The density of a measured range where real frames are weighed: of the map's surface, with everything that blurs it
/// along the ray, or of something else, anywhere up to max_range; with one of its own where the map shows nothing.
///
/// Variance along the ray, with c = |normal . ray|:
///   sensor + (texel + model_sigma^2 + lateral^2 (1 - c^2)) / c^2
/// lateral is the frame's standard deviation across the ray.
///
/// source  Thrun, Burgard, Fox, "Probabilistic Robotics", section 6.3 (hit and random parts of the beam model)
struct RangeMixture {
  double outlier_share = 0.1, max_range = 10.0, miss_density = 0.1, model_sigma = 0.005;

  /// Declares the members as parameters.
  void declare(Params& params);

  /// For mixture_score(), which gives the sum of the logs over a block.
  MixtureTerms terms() const {
    return {outlier_share / max_range, miss_density, 1 - outlier_share, model_sigma * model_sigma};
  }
  /// Densities of a range, 1/m, each times its part's prior probability.
  struct Parts {
    double surface, outlier;
    double sum() const { return surface + outlier; }
  };
  /// Of the i-th pixel, which must hit something.
  Parts parts(const PixelBlock& pixels, std::size_t i) const;
};

}  // namespace ppm
