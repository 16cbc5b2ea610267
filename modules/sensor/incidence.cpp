#include "modules/sensor/incidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ppm {
namespace {

/// Inverse depth of an image with a margin of NaN on all sides, so that neighbours need no test.
struct InverseDepth {
  int margin, stride;
  std::vector<float> values;

  InverseDepth(const Frame& frame, int margin_) : margin(margin_), stride(frame.camera.cols + 2 * margin_) {
    const Camera& camera = frame.camera;
    values.assign(static_cast<std::size_t>(stride * (camera.rows + 2 * margin)),
                  std::numeric_limits<float>::quiet_NaN());
    for (int y = 0; y < camera.rows; ++y) {
      const float* depth = &frame.depth[static_cast<std::size_t>(y * camera.cols)];
      std::transform(depth, depth + camera.cols, &values[offset(y)], [](float z) { return 1.0f / z; });
    }
  }
  std::size_t offset(int y) const { return static_cast<std::size_t>(stride * (y + margin) + margin); }
};

/// The smaller of two slopes, or the one that is a number.
float milder(float before, float after) {
  return (std::abs(before) < std::abs(after)) | (after != after) ? before : after;
}

}  // namespace

std::vector<float> incidence_cosine(const Frame& frame, double baseline) {
  const Camera& camera = frame.camera;
  const int step = std::max(1, static_cast<int>(std::lround(baseline * std::abs(camera.fx))));
  const InverseDepth inverse(frame, step);
  const int below = step * inverse.stride;
  const auto fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy), cx = static_cast<float>(camera.cx);
  const float slope_x = fx / static_cast<float>(step), slope_y = fy / static_cast<float>(step);
  std::vector<float> cosine(frame.depth.size());
  for (int y = 0; y < camera.rows; ++y) {
    const float v = static_cast<float>((y - camera.cy) / camera.fy);
    const float* row = &inverse.values[inverse.offset(y)];
    float* out = &cosine[static_cast<std::size_t>(y * camera.cols)];
    for (int x = 0; x < camera.cols; ++x) {
      // With ray (u, v, 1), the plane n . point = 1 has inverse depth n . ray: a, b and c are its normal.
      const float u = (static_cast<float>(x) - cx) / fx, d = row[x];
      const float a = milder(d - row[x - step], row[x + step] - d) * slope_x;
      const float b = milder(d - row[x - below], row[x + below] - d) * slope_y;
      const float c = d - a * u - b * v;
      out[x] = d / std::sqrt((a * a + b * b + c * c) * (u * u + v * v + 1));
    }
  }
  return cosine;
}

}  // namespace ppm
