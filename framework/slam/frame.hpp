#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/core/record.hpp"
#include "framework/core/se3.hpp"
#include "framework/slam/camera.hpp"

namespace ppm {

/// What an inertial unit measured at a time, in the axes of the moving body (base).
struct ImuSample {
  double stamp_s = 0;
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero();   ///< rad/s
  Eigen::Vector3d accel = Eigen::Vector3d::Zero();  ///< m/s^2, specific force: 9.81 upwards at rest
};

/// One image of a range camera. Immutable once made; shared by all nodes.
struct Frame {
  std::int64_t index = 0;  ///< the source's own number of the frame
  double stamp_s = 0;
  Camera camera;
  Pose T_base_camera = Pose::Identity();  ///< camera in the moving body; identity for handheld sequences
  std::vector<float> depth;               ///< [rows*cols] m along the optical axis, row-major; NaN = no return
  std::vector<float> sigma;               ///< [rows*cols] m, standard deviation of depth; NaN where depth is
  /// Standard deviation of a pixel's place across the line of sight, in pixels of this image: it counts on slanted
  /// surfaces.
  float lateral_px = 0.5f;
  /// [rows*cols] strength of the signal behind each depth (a time-of-flight camera's amplitude or confidence), not negative,
  /// larger is better, in the sensor's own units; empty where the source has none. Means nothing where there is no return.
  std::vector<float> confidence;
  std::vector<std::uint8_t> color;        ///< [rows*cols*3] RGB, row-major; empty where the source has none
  float color_sigma = 0.03f;              ///< standard deviation of a colour channel, of 0 .. 1
  std::optional<Pose> T_world_camera_ref;  ///< the data set's reference pose, where it has one
  /// Since the image before, that one's stamp excluded, up to this one's, ascending; empty where the source has none. The
  /// first image's are those before it.
  std::vector<ImuSample> imu;
  std::optional<Pose> T_odom_base;  ///< where odometry says that the body is, in a frame of its own that drifts
  bool held_out = false;            ///< its pose may be sought, but no map may learn from it

  bool valid(int pixel) const { return depth[static_cast<std::size_t>(pixel)] == depth[static_cast<std::size_t>(pixel)]; }
};

void save(RecordWriter& out, const ImuSample& sample);
void load(RecordReader& in, ImuSample& sample);
void save(RecordWriter& out, const Frame& frame);
void load(RecordReader& in, Frame& frame);

}  // namespace ppm
