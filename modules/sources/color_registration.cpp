#include "modules/sources/color_registration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ppm {
namespace {

/// The colour at (x, y) of an image, interpolated between its pixels and taken to its border.
void sample(const std::vector<std::uint8_t>& image, const Camera& camera, double x, double y, std::uint8_t* out) {
  const double u = std::clamp(x, 0.0, camera.cols - 1.0), v = std::clamp(y, 0.0, camera.rows - 1.0);
  const int x0 = std::clamp(static_cast<int>(u), 0, std::max(camera.cols - 2, 0));
  const int y0 = std::clamp(static_cast<int>(v), 0, std::max(camera.rows - 2, 0));
  const int x1 = std::min(x0 + 1, camera.cols - 1), y1 = std::min(y0 + 1, camera.rows - 1);
  const double a = u - x0, b = v - y0;
  auto pixel = [&](int px, int py) { return &image[3 * static_cast<std::size_t>(py * camera.cols + px)]; };
  const std::uint8_t *p00 = pixel(x0, y0), *p10 = pixel(x1, y0), *p01 = pixel(x0, y1), *p11 = pixel(x1, y1);
  for (int c = 0; c < 3; ++c)
    out[c] = static_cast<std::uint8_t>(
        std::lround((1 - b) * ((1 - a) * p00[c] + a * p10[c]) + b * ((1 - a) * p01[c] + a * p11[c])));
}

}  // namespace

void register_color(const ColorCamera& camera, Frame& frame) {
  const std::vector<std::uint8_t> image = std::exchange(frame.color, {});
  const Camera& depth = frame.camera;
  const double focal_y = std::copysign(camera.focal_px, depth.fy) * std::abs(depth.fy / depth.fx);
  frame.color.resize(image.size());
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x) {
      const auto i = static_cast<std::size_t>(y * depth.cols + x);
      const bool measured = frame.valid(static_cast<int>(i)) && frame.depth[i] > 0;
      Eigen::Vector3d p = depth.ray(x, y);
      if (measured) p = frame.depth[i] * p + camera.t_color_depth;
      sample(image, depth, camera.focal_px * p.x() / p.z() + depth.cx, focal_y * p.y() / p.z() + depth.cy,
             &frame.color[3 * i]);
    }
}

}  // namespace ppm
