#include "modules/maps/picture/path_drawing.hpp"

#include <algorithm>

namespace ppm {
namespace {

constexpr std::size_t kCameras = 12;
constexpr double kCameraSize = 0.18;  // m

}  // namespace

std::vector<std::vector<Eigen::Vector3d>> frustum(const Pose& T, double size) {
  const double w = 0.6 * size, h = 0.45 * size;
  auto p = [&](double x, double y, double z) -> Eigen::Vector3d { return T * Eigen::Vector3d(x, y, z); };
  const Eigen::Vector3d eye = T.translation();
  const Eigen::Vector3d a = p(-w, -h, size), b = p(w, -h, size), c = p(w, h, size), d = p(-w, h, size);
  return {{a, b, c, d, a},
          {a, eye, b},
          {c, eye, d},
          {p(-0.5 * w, -1.15 * h, size), p(0, -1.6 * h, size), p(0.5 * w, -1.15 * h, size)}};
}

void draw_path(Canvas& canvas, const std::vector<Pose>& path, double scale) {
  if (path.empty()) return;
  std::vector<Eigen::Vector3d> line;
  for (const auto& T : path) line.push_back(T.translation());
  canvas.polylines({line}, {{0.80f, 0.10f, 0.12f}, 2.6 * scale, 1.0f, 0.35f});
  std::vector<std::vector<Eigen::Vector3d>> cameras;
  const std::size_t step = std::max<std::size_t>(1, path.size() / kCameras);
  for (std::size_t i = 0; i + 1 < path.size(); i += step)
    for (auto& edge : frustum(path[i], kCameraSize)) cameras.push_back(std::move(edge));
  canvas.polylines(cameras, {{0.08f, 0.16f, 0.38f}, 1.4 * scale, 0.9f, 0.25f});
  canvas.polylines(frustum(path.back(), 1.6 * kCameraSize), {{0.85f, 0.05f, 0.08f}, 2.2 * scale, 1.0f, 0.5f});
}

}  // namespace ppm
