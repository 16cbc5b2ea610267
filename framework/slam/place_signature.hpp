#pragma once
#include <array>
#include <cstddef>

#include "framework/slam/frame.hpp"
#include "framework/slam/prediction.hpp"

namespace ppm {

/// What a place looks like from a pose, in a few hundred numbers: the mean logarithm of the depth in each cell of a grid over
/// the image. Two views of a place from about the same point agree in it up to the turn between them, which shifts it.
/// Source: Milford, Wyeth, "SeqSLAM", ICRA 2012 (tiny images as places, compared with shifts); depth in place of brightness.
struct PlaceSignature {
  static constexpr int kCols = 20, kRows = 15;
  std::array<float, kCols * kRows> log_depth;  ///< ln m, row-major; NaN = too little of the cell is known

  /// Of a measured image, or of a view with its arrays filled. Any size from kCols x kRows on.
  static PlaceSignature of(const Frame& frame);
  static PlaceSignature of(const Prediction& view);
};

/// How alike two signatures are where one is shifted against the other.
struct SignatureMatch {
  /// Mean difference of the cells that both know, each cut off at kMostDifference, with the cells that the first knows and
  /// the shifted second does not as kUnknown; lower is more alike.
  double difference = 0;
  int cols = 0, rows = 0;  ///< cell (x + cols, y + rows) of the first shows what cell (x, y) of the second does
  static constexpr float kMostDifference = 0.4f, kUnknown = 0.2f;
};

/// The best match of two signatures over all shifts up to so many columns and rows either way.
SignatureMatch best_match(const PlaceSignature& seen, const PlaceSignature& known, int most_cols, int most_rows);

/// The rotation between the cameras of two matching views: T_known_seen, for the camera of the full image.
Pose turn_of(const SignatureMatch& match, const Camera& camera);

}  // namespace ppm
