#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "framework/slam/frame.hpp"
#include "framework/slam/measured_surface.hpp"
#include "framework/slam/prediction.hpp"

namespace ppm {

/// What a pixel of the frame measured, map frame.
struct MeasuredPoint {
  Eigen::Vector3f position;  ///< m
  Eigen::Vector3f ray;       ///< unit, from the camera
  float range = 0;           ///< m
  float range_variance = 0;    ///< m^2
  float lateral_variance = 0;  ///< m^2 across the ray
  float footprint = 0;         ///< m: the distance of a pixel's neighbour at this depth, across the ray

  /// Of the position along a unit normal, m^2.
  float variance_along(const Eigen::Vector3f& normal) const {
    const float c = normal.dot(ray), square = std::min(c * c, 1.0f);
    return range_variance * square + lateral_variance * (1 - square);
  }
};

/// The measured points of a frame on the grid of a prediction of it, from the prediction's pose.
class MeasuredPoints {
 public:
  MeasuredPoints(const Frame& frame, const Prediction& view)
      : frame_(frame), view_(view), R_(view.T_map_camera.linear().cast<float>()) {}

  /// The frame's pixel of a pixel of the view.
  int source(int x, int y) const { return y * view_.stride * frame_.camera.cols + x * view_.stride; }
  bool valid(int x, int y) const { return frame_.valid(source(x, y)); }
  /// Of a valid one.
  MeasuredPoint at(int x, int y) const {
    const auto pixel = static_cast<std::size_t>(source(x, y));
    const Eigen::Vector3d direction = view_.camera.ray(x, y);
    const float z = frame_.depth[pixel], length = static_cast<float>(direction.norm()), sigma = frame_.sigma[pixel] * length;
    const auto f = static_cast<float>(std::min(std::abs(view_.camera.fx), std::abs(view_.camera.fy)));
    MeasuredPoint m;
    m.ray = R_ * (direction.cast<float>() / length);
    m.range = z * length;
    m.position = (view_.T_map_camera.translation() + (m.range * m.ray).cast<double>()).cast<float>();
    m.range_variance = sigma * sigma;
    m.footprint = z / f;
    const float lateral = m.footprint * frame_.lateral_px / static_cast<float>(view_.stride);
    m.lateral_variance = lateral * lateral;
    return m;
  }
  /// Unit, towards the camera; zero where none is known. See measured_normal(); beyond an edge the next pixels are taken.
  Eigen::Vector3f normal(int x, int y, int reach, double jump_m) const {
    const int px = x * view_.stride, py = y * view_.stride;
    Eigen::Vector3f n = measured_normal(frame_, px, py, reach, jump_m);
    if (reach > 1 && n.isZero()) n = measured_normal(frame_, px, py, 1, jump_m);
    return R_ * n;
  }

 private:
  const Frame& frame_;
  const Prediction& view_;
  Eigen::Matrix3f R_;
};

}  // namespace ppm
