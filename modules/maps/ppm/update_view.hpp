#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "framework/core/parallel.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/prediction.hpp"

namespace ppm {

/// Calls body(y) once for each row of an image, several rows to a worker's turn.
template <class Body>
void for_each_row(const Workers& workers, int rows, const Body& body) {
  for_each_band(workers, rows, kBandRows, [&](const Rows& band) {
    for (int y = band.first; y < band.end; ++y) body(y);
  });
}

/// A frame beside what the map predicts for it, pixel by pixel, on the prediction's grid. Points are relative to the
/// camera's centre with the axes of the map frame, so that floats keep their precision far from the map's origin.
class UpdateView {
 public:
  static constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

  /// Fills the view; keeps capacity. The prediction must be one of this frame's camera (its camera is the frame's
  /// decimated by prediction.stride) and must outlive the view.
  void build(const Frame& frame, const Prediction& prediction, const Workers& workers);

  int cols() const { return camera.cols; }
  int rows() const { return camera.rows; }
  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < camera.cols && y < camera.rows; }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.cols) + static_cast<std::size_t>(x);
  }
  bool measured(std::size_t p) const { return depth[p] == depth[p]; }

  /// Direction through image coordinates (x, y), unit component along the optical axis: point = depth * ray.
  Eigen::Vector3f ray(float x, float y) const {
    return axes.col(0) * ((x - cx) * inv_fx) + axes.col(1) * ((y - cy) * inv_fy) + axes.col(2);
  }
  /// Image coordinates and depth (x, y, z) of a point; z may be <= 0, then x and y mean nothing.
  Eigen::Vector3f project(const Eigen::Vector3f& p) const {
    const Eigen::Vector3f q = axes.transpose() * p;
    const float w = 1.0f / q.z();
    return {fx * q.x() * w + cx, fy * q.y() * w + cy, q.z()};
  }
  /// A map point as this view counts it, and back.
  Eigen::Vector3f relative(const Eigen::Vector3f& p_map) const { return (p_map.cast<double>() - centre).cast<float>(); }
  Eigen::Vector3f absolute(const Eigen::Vector3f& p) const { return (p.cast<double>() + centre).cast<float>(); }
  /// Cosine between a unit normal and the line of sight to a point, positive when the normal faces the camera.
  static float facing(const Eigen::Vector3f& n, const Eigen::Vector3f& p) { return -n.dot(p) / p.norm(); }

  Camera camera;
  float fx = 1, fy = 1, cx = 0, cy = 0, inv_fx = 1, inv_fy = 1;
  float lateral_px = 0;    ///< the frame's, in pixels of this grid
  Eigen::Matrix3f axes;    ///< rotation part of T_map_camera
  Eigen::Vector3d centre;  ///< camera centre, map frame, m
  const Prediction* prediction = nullptr;
  std::vector<float> depth;             ///< [px] m along the optical axis; NaN = no return
  std::vector<float> sigma;             ///< [px] m, of depth
  std::vector<Eigen::Vector3f> point;   ///< [px] measured point; NaN = no return
  std::vector<Eigen::Vector3f> normal;  ///< [px] of the predicted element, unit, facing the camera; 0 at a miss
  std::vector<float> offset;            ///< [px] the described surface's plane: normal . x = offset; 0 at a miss

 private:
  void set_camera(const Camera& grid, const Pose& T_map_camera);

  std::vector<float> inverse_length_;  // [px] of ray(), 1 / its length
};

}  // namespace ppm
