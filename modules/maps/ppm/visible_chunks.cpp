#include "modules/maps/ppm/visible_chunks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ppm {
namespace {

constexpr double kNear = 1e-4;     // m: what is cut off in front of the camera's plane
constexpr double kMargin = 1e-2;   // px: rounding of rays and boxes
constexpr double kInside = 1e-2;   // m: a camera this near to a box may see it anywhere

// Grows with image points.
struct ImageRect {
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
  void add(const Eigen::Vector2d& p) {
    x0 = std::min(x0, p.x());
    y0 = std::min(y0, p.y());
    x1 = std::max(x1, p.x());
    y1 = std::max(y1, p.y());
  }
};

// The image of the part of a box in front of the camera: corners, and where edges pass the near plane.
ImageRect image_of(const Eigen::AlignedBox3f& box, const Camera& camera, const Pose& T_camera_map) {
  std::array<Eigen::Vector3d, 8> corner;
  for (int i = 0; i < 8; ++i)
    corner[static_cast<std::size_t>(i)] =
        T_camera_map * box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i)).cast<double>();
  ImageRect rect;
  for (std::size_t i = 0; i < 8; ++i) {
    if (corner[i].z() >= kNear) rect.add(camera.project(corner[i]));
    for (std::size_t axis = 1; axis < 8; axis *= 2) {
      const std::size_t j = i | axis;
      if (j == i || (corner[i].z() >= kNear) == (corner[j].z() >= kNear)) continue;
      const double t = (kNear - corner[i].z()) / (corner[j].z() - corner[i].z());
      Eigen::Vector3d p = corner[i] + t * (corner[j] - corner[i]);
      p.z() = kNear;
      rect.add(camera.project(p));
    }
  }
  return rect;
}

/// Whether an image rectangle meets the image grown by `margin` px on every side.
bool meets(const ImageRect& rect, const Camera& camera, double margin) {
  return rect.x1 + margin >= 0 && rect.y1 + margin >= 0 && rect.x0 - margin <= camera.cols - 1 &&
         rect.y0 - margin <= camera.rows - 1;
}

}  // namespace

std::vector<VisibleChunk> visible_chunks(const PpmMap& map, const Camera& camera, const Pose& T_map_camera) {
  const Pose T_camera_map = T_map_camera.inverse();
  const Eigen::Vector3f centre = T_map_camera.translation().cast<float>();
  std::vector<VisibleChunk> visible;
  for (std::uint32_t i = 0; i < map.table().size(); ++i) {
    const Geometry& geometry = *map.table()[i].geometry;
    if (geometry.face.empty()) continue;
    VisibleChunk v{i, geometry.box.exteriorDistance(centre), 0, 0, camera.cols - 1, camera.rows - 1};
    if (v.distance > kInside) {
      const ImageRect rect = image_of(geometry.box, camera, T_camera_map);
      const double right = camera.cols - 1, bottom = camera.rows - 1;
      if (!meets(rect, camera, kMargin)) continue;
      v.x0 = static_cast<int>(std::ceil(std::max(rect.x0 - kMargin, 0.0)));
      v.y0 = static_cast<int>(std::ceil(std::max(rect.y0 - kMargin, 0.0)));
      v.x1 = static_cast<int>(std::floor(std::min(rect.x1 + kMargin, right)));
      v.y1 = static_cast<int>(std::floor(std::min(rect.y1 + kMargin, bottom)));
      if (v.x0 > v.x1 || v.y0 > v.y1) continue;
    }
    visible.push_back(v);
  }
  std::sort(visible.begin(), visible.end(), [](const VisibleChunk& a, const VisibleChunk& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.chunk < b.chunk;
  });
  return visible;
}

std::vector<std::uint32_t> chunks_in_image(const PpmMap& map, const Camera& camera, const Pose& T_map_camera) {
  const Pose T_camera_map = T_map_camera.inverse();
  const Eigen::Vector3f centre = T_map_camera.translation().cast<float>();
  std::vector<std::uint32_t> chunks;
  for (std::uint32_t i = 0; i < map.table().size(); ++i) {
    const Geometry& geometry = *map.table()[i].geometry;
    if (geometry.face.empty()) continue;
    if (geometry.box.exteriorDistance(centre) <= kInside || meets(image_of(geometry.box, camera, T_camera_map), camera, 1))
      chunks.push_back(i);
  }
  return chunks;
}

}  // namespace ppm
