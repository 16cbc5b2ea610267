#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/core/record.hpp"
#include "framework/core/se3.hpp"
#include "framework/slam/camera.hpp"

namespace ppm {

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

  bool valid(int pixel) const { return depth[static_cast<std::size_t>(pixel)] == depth[static_cast<std::size_t>(pixel)]; }
};

void save(RecordWriter& out, const Frame& frame);
void load(RecordReader& in, Frame& frame);

}  // namespace ppm
