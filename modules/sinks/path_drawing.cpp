#include "modules/sinks/path_drawing.hpp"

#include <algorithm>

namespace ppm {
namespace {

constexpr std::size_t kCameras = 12;
constexpr double kCameraSize = 0.18;  // m

std::vector<std::vector<Eigen::Vector3d>> other_paths(const ParticleSet& belief, std::size_t best) {
  std::vector<std::vector<Eigen::Vector3d>> paths;
  for (std::size_t i = 0; i < belief.size(); ++i) {
    const auto& path = belief.trajectory[i];
    const bool copy = std::find(belief.trajectory.begin(), belief.trajectory.begin() + static_cast<std::ptrdiff_t>(i),
                                path) != belief.trajectory.begin() + static_cast<std::ptrdiff_t>(i);
    if (i != best && !copy) paths.push_back(positions(path.poses()));
  }
  return paths;
}

}  // namespace

std::vector<Eigen::Vector3d> positions(const std::vector<StampedPose>& path) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(path.size());
  for (const auto& pose : path) points.push_back(pose.T_map_camera.translation());
  return points;
}

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

void draw_paths(Canvas& canvas, const ParticleSet& belief, double scale) {
  const auto best = belief.best();
  canvas.polylines(other_paths(belief, best), {{0.25f, 0.35f, 0.60f}, 1.0 * scale, 0.35f, 0.12f});
  const auto path = belief.trajectory[best].poses();
  if (path.empty()) return;
  canvas.polylines({positions(path)}, {{0.80f, 0.10f, 0.12f}, 2.6 * scale, 1.0f, 0.35f});
  std::vector<std::vector<Eigen::Vector3d>> cameras;
  const std::size_t step = std::max<std::size_t>(1, path.size() / kCameras);
  for (std::size_t i = 0; i + 1 < path.size(); i += step)
    for (auto& line : frustum(path[i].T_map_camera, kCameraSize)) cameras.push_back(std::move(line));
  canvas.polylines(cameras, {{0.08f, 0.16f, 0.38f}, 1.4 * scale, 0.9f, 0.25f});
  canvas.polylines(frustum(path.back().T_map_camera, 1.6 * kCameraSize),
                   {{0.85f, 0.05f, 0.08f}, 2.2 * scale, 1.0f, 0.5f});
}

}  // namespace ppm
