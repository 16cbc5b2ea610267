#include "framework/slam/measured_pixels.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm {

bool at_depth_jump(const Frame& frame, int x, int y, double jump_m) {
  const Camera& camera = frame.camera;
  auto index = [&](int px, int py) { return static_cast<std::size_t>(py * camera.cols + px); };
  const double z = frame.depth[index(x, y)];
  const double limit = std::max(jump_m, 5.0 * frame.sigma[index(x, y)]);
  auto off = [&](std::size_t before, std::size_t after) {
    const double bend = 1.0 / frame.depth[before] + 1.0 / frame.depth[after] - 2.0 / z;
    return std::abs(bend) * z * z > limit;  // false where a neighbour has no return
  };
  return (x > 0 && x + 1 < camera.cols && off(index(x - 1, y), index(x + 1, y))) ||
         (y > 0 && y + 1 < camera.rows && off(index(x, y - 1), index(x, y + 1)));
}

MeasuredPixels measured_pixels(const Frame& frame, const Camera& predicted, int stride, const PixelGrid& grid) {
  PPM_CHECK(predicted == frame.camera.decimated(stride), "the prediction is of another camera than the frame");
  MeasuredPixels out;
  for (int y = grid.first_y; y < predicted.rows; y += grid.step)
    for (int x = grid.first_x; x < predicted.cols; x += grid.step) {
      const int at = stride * y * frame.camera.cols + stride * x;
      if (!frame.valid(at)) continue;
      if (grid.jump_m > 0 && at_depth_jump(frame, stride * x, stride * y, grid.jump_m)) continue;
      const auto source = static_cast<std::size_t>(at);
      const double length = predicted.ray(x, y).norm();
      out.pixel.push_back(static_cast<std::uint32_t>(y * predicted.cols + x));
      out.source.push_back(static_cast<std::uint32_t>(at));
      out.range.push_back(static_cast<float>(frame.depth[source] * length));
      out.variance.push_back(static_cast<float>(std::pow(frame.sigma[source] * length, 2)));
      out.lateral.push_back(static_cast<float>(frame.lateral_px * frame.depth[source] / std::abs(frame.camera.fx)));
    }
  return out;
}

}  // namespace ppm
