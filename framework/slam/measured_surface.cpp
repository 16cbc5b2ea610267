#include "framework/slam/measured_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "framework/core/error.hpp"
#include "framework/slam/measured_pixels.hpp"

namespace ppm {

namespace {

Eigen::Vector3f point(const Frame& frame, int x, int y) {
  const float z = frame.depth[static_cast<std::size_t>(y * frame.camera.cols + x)];
  return z * frame.camera.ray(x, y).cast<float>();
}

MeasuredSurface::Level level(const Frame& frame, int step, int reach, double jump_m) {
  MeasuredSurface::Level out;
  out.step = step;
  const Camera& camera = frame.camera;
  for (int y = step / 2; y < camera.rows; y += step) {
    for (int x = step / 2; x < camera.cols; x += step) {
      const int pixel = y * camera.cols + x;
      if (!frame.valid(pixel) || at_depth_jump(frame, x, y, jump_m)) continue;
      const Eigen::Vector3f p = point(frame, x, y), n = measured_normal(frame, x, y, reach, jump_m);
      const float sigma = frame.sigma[static_cast<std::size_t>(pixel)];
      out.x.push_back(p.x()), out.y.push_back(p.y()), out.z.push_back(p.z());
      out.nx.push_back(n.x()), out.ny.push_back(n.y()), out.nz.push_back(n.z());
      out.variance.push_back(sigma * sigma);
    }
  }
  return out;
}

}  // namespace

Eigen::Vector3f measured_normal(const Frame& frame, int x, int y, int reach, double jump_m) {
  const Camera& camera = frame.camera;
  if (x < reach || y < reach || x + reach >= camera.cols || y + reach >= camera.rows) return Eigen::Vector3f::Zero();
  const Eigen::Vector3f at = point(frame, x, y);
  const Eigen::Vector3f across = point(frame, x + reach, y) - point(frame, x - reach, y);
  const Eigen::Vector3f down = point(frame, x, y + reach) - point(frame, x, y - reach);
  const Eigen::Vector3f n = across.cross(down);
  const float length = n.norm();
  // Not-a-number compares false: neighbours without a return give no normal.
  const bool flat = std::abs(across.z()) < 2 * jump_m && std::abs(down.z()) < 2 * jump_m;
  if (!flat || !(length > 0)) return Eigen::Vector3f::Zero();
  return n.dot(at) > 0 ? Eigen::Vector3f(-n / length) : Eigen::Vector3f(n / length);
}

void MeasuredSurface::build(const Frame& frame, const std::vector<int>& steps, double jump_m) {
  PPM_CHECK(!steps.empty(), "a measured surface has at least one level");
  const int finest = *std::ranges::min_element(steps);
  levels.clear();
  for (int step : steps) levels.push_back(level(frame, step, std::max(1, finest / 2), jump_m));
  measured = 0;
  for (int y = finest / 2; y < frame.camera.rows; y += finest)
    for (int x = finest / 2; x < frame.camera.cols; x += finest) measured += frame.valid(y * frame.camera.cols + x);
}

}  // namespace ppm
