#pragma once
#include <Eigen/Core>

namespace ppm {

/// Pinhole camera. Camera frame: x to the right of the image, y along increasing rows when fy > 0, z forward (optical axis).
/// fy < 0 is allowed (ICL-NUIM: image rows grow against the camera's y axis); never zero.
/// Pixel (column x, row y) has its centre at the integer coordinates (x, y).
struct Camera {
  int cols = 0;
  int rows = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;  // px

  int pixels() const { return cols * rows; }
  /// The ray through a pixel with unit z component: point = depth * ray.
  Eigen::Vector3d ray(double x, double y) const { return {(x - cx) / fx, (y - cy) / fy, 1.0}; }
  /// Pixel coordinates (x, y) of a point in the camera frame with z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& p_camera) const {
    return {fx * p_camera.x() / p_camera.z() + cx, fy * p_camera.y() / p_camera.z() + cy};
  }
  /// The camera whose pixel (x, y) is this one's pixel (x0 + stride * x, y0 + stride * y).
  Camera decimated(int stride, int x0 = 0, int y0 = 0) const;
  bool operator==(const Camera&) const = default;
};

}  // namespace ppm
