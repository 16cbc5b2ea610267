#pragma once
#include <cstddef>

namespace ppm {

/// How well one particle's view, or a part of it, explains a frame.
struct ViewScore {
  double log_likelihood = 0;
  std::size_t hits = 0, misses = 0;  ///< compared pixels where the map shows something, and nothing
  std::size_t outliers = 0;          ///< hits that the likelihood holds for something else than the map's surface
  double residual_sum = 0;           ///< m, of |measured - expected| over the hits

  ViewScore& operator+=(const ViewScore& part) {
    log_likelihood += part.log_likelihood;
    hits += part.hits;
    misses += part.misses;
    outliers += part.outliers;
    residual_sum += part.residual_sum;
    return *this;
  }
};

}  // namespace ppm
