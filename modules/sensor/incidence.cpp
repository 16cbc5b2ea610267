#include "modules/sensor/incidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ppm {
namespace {

/// The smaller of two slopes, or the one that is a number.
float milder(float before, float after) {
  if (std::isnan(before)) return after;
  return std::abs(before) < std::abs(after) ? before : std::isnan(after) ? before : after;
}

}  // namespace

std::vector<float> incidence_cosine(const Frame& frame, double baseline) {
  const Camera& camera = frame.camera;
  const int step = std::max(1, static_cast<int>(std::lround(baseline * std::abs(camera.fx))));
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> inverse(frame.depth.size()), cosine(frame.depth.size());
  for (std::size_t p = 0; p < inverse.size(); ++p) inverse[p] = 1.0f / frame.depth[p];
  const auto at = [&](int x, int y) {
    return x < 0 || y < 0 || x >= camera.cols || y >= camera.rows
               ? nan
               : inverse[static_cast<std::size_t>(y * camera.cols + x)];
  };
  const auto fx = static_cast<float>(camera.fx) / static_cast<float>(step);
  const auto fy = static_cast<float>(camera.fy) / static_cast<float>(step);
  for (int y = 0; y < camera.rows; ++y) {
    const float v = static_cast<float>((y - camera.cy) / camera.fy);
    for (int x = 0; x < camera.cols; ++x) {
      // With ray (u, v, 1), the plane n . point = 1 has inverse depth n . ray: a, b and c are its normal.
      const float u = static_cast<float>((x - camera.cx) / camera.fx);
      const float d = at(x, y);
      const float a = milder(d - at(x - step, y), at(x + step, y) - d) * fx;
      const float b = milder(d - at(x, y - step), at(x, y + step) - d) * fy;
      const float c = d - a * u - b * v;
      cosine[static_cast<std::size_t>(y * camera.cols + x)] =
          d / std::sqrt((a * a + b * b + c * c) * (u * u + v * v + 1));
    }
  }
  return cosine;
}

}  // namespace ppm
