#include "framework/slam/place_signature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

constexpr auto kCells = static_cast<std::size_t>(PlaceSignature::kCols * PlaceSignature::kRows);
constexpr float kLeastKnown = 0.3f;  // share of a cell's pixels

/// Means over cells of what depth_at says, NaN where it knows nothing.
template <class DepthAt>
PlaceSignature signature(const Camera& camera, DepthAt depth_at) {
  std::array<float, kCells> sum{}, known{}, all{};
  for (int y = 0; y < camera.rows; ++y) {
    for (int x = 0; x < camera.cols; ++x) {
      const int col = x * PlaceSignature::kCols / camera.cols, row = y * PlaceSignature::kRows / camera.rows;
      const auto cell = static_cast<std::size_t>(row * PlaceSignature::kCols + col);
      const float depth = depth_at(static_cast<std::size_t>(y * camera.cols + x), x, y);
      all[cell] += 1;
      if (!(depth > 0)) continue;
      known[cell] += 1;
      sum[cell] += std::log(depth);
    }
  }
  PlaceSignature out;
  for (std::size_t c = 0; c < kCells; ++c)
    out.log_depth[c] =
        known[c] > 0 && known[c] >= kLeastKnown * all[c] ? sum[c] / known[c] : std::numeric_limits<float>::quiet_NaN();
  return out;
}

double difference(const PlaceSignature& seen, const PlaceSignature& known, int cols, int rows) {
  constexpr int C = PlaceSignature::kCols, R = PlaceSignature::kRows;
  float sum = 0, cells = 0;
  for (int y = 0; y < R; ++y) {
    for (int x = 0; x < C; ++x) {
      const float a = seen.log_depth[static_cast<std::size_t>(y * C + x)];
      if (a != a) continue;
      cells += 1;
      const int kx = x - cols, ky = y - rows;
      const bool inside = kx >= 0 && ky >= 0 && kx < C && ky < R;
      const float b = inside ? known.log_depth[static_cast<std::size_t>(ky * C + kx)] : a;
      if (!inside || b != b)
        sum += SignatureMatch::kUnknown;
      else
        sum += std::min(std::abs(a - b), SignatureMatch::kMostDifference);
    }
  }
  return cells > 0 ? static_cast<double>(sum / cells) : static_cast<double>(SignatureMatch::kMostDifference);
}

}  // namespace

PlaceSignature PlaceSignature::of(const Frame& frame) {
  return signature(frame.camera, [&](std::size_t pixel, int, int) { return frame.depth[pixel]; });
}

PlaceSignature PlaceSignature::of(const Prediction& view) {
  PPM_CHECK(!view.deferred, "the view's arrays are not filled");
  return signature(view.camera, [&](std::size_t pixel, int x, int y) {
    if (view.range[pixel] == Prediction::kMiss) return 0.0f;
    return view.range[pixel] / static_cast<float>(view.camera.ray(x, y).norm());
  });
}

SignatureMatch best_match(const PlaceSignature& seen, const PlaceSignature& known, int most_cols, int most_rows) {
  SignatureMatch best;
  best.difference = std::numeric_limits<double>::infinity();
  for (int rows = -most_rows; rows <= most_rows; ++rows) {
    for (int cols = -most_cols; cols <= most_cols; ++cols) {
      const double d = difference(seen, known, cols, rows);
      if (d < best.difference) best = {d, cols, rows};
    }
  }
  return best;
}

Pose turn_of(const SignatureMatch& match, const Camera& camera) {
  const double cell_x = static_cast<double>(camera.cols) / PlaceSignature::kCols;
  const double cell_y = static_cast<double>(camera.rows) / PlaceSignature::kRows;
  // What the seen image has there, the known one has in its middle.
  const Eigen::Vector3d there = camera.ray(camera.cx + match.cols * cell_x, camera.cy + match.rows * cell_y);
  return Pose(Eigen::Quaterniond::FromTwoVectors(there, Eigen::Vector3d::UnitZ()));
}

}  // namespace ppm
