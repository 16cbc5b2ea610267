#pragma once
#include "framework/slam/view_score.hpp"

namespace ppm {

/// How far a particle's view explains the frame, as the last node that compared them found. A weighting sets it.
struct ViewFit {
  float outliers = 0;  ///< share of the compared pixels that the map shows, where it shows something else
  float misses = 0;    ///< share of the compared pixels where the map shows nothing

  static ViewFit of(const ViewScore& score) {
    auto share = [](std::size_t part, std::size_t whole) {
      return whole > 0 ? static_cast<float>(part) / static_cast<float>(whole) : 0.0f;
    };
    return {share(score.outliers, score.hits), share(score.misses, score.hits + score.misses)};
  }
};

/// The column of a belief that holds each particle's ViewFit; with it goes the facet "fit".
constexpr const char* kViewFitColumn = "fit";

}  // namespace ppm
