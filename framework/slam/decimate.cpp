#include "framework/slam/decimate.hpp"

#include "framework/core/error.hpp"

namespace ppm {
namespace {

/// channels: values a pixel. An array that the frame does not have stays empty.
template <class T>
std::vector<T> kept(const std::vector<T>& values, const Camera& from, const Camera& to, int stride, int channels) {
  std::vector<T> out;
  if (values.empty()) return out;
  PPM_CHECK(values.size() == static_cast<std::size_t>(from.pixels() * channels), "{} values for {}x{} pixels of {}",
            values.size(), from.cols, from.rows, channels);
  out.reserve(static_cast<std::size_t>(to.pixels() * channels));
  for (int y = 0; y < to.rows; ++y)
    for (int x = 0; x < to.cols; ++x) {
      const T* pixel = &values[static_cast<std::size_t>(channels * (stride * y * from.cols + stride * x))];
      out.insert(out.end(), pixel, pixel + channels);
    }
  return out;
}

}  // namespace

Frame decimated(const Frame& frame, int stride) {
  const Camera& from = frame.camera;
  Frame out;
  out.index = frame.index;
  out.stamp_s = frame.stamp_s;
  out.camera = from.decimated(stride);
  out.T_base_camera = frame.T_base_camera;
  out.T_world_camera_ref = frame.T_world_camera_ref;
  out.imu = frame.imu;
  out.T_odom_base = frame.T_odom_base;
  out.held_out = frame.held_out;
  out.lateral_px = frame.lateral_px / static_cast<float>(stride);
  out.depth = kept(frame.depth, from, out.camera, stride, 1);
  out.sigma = kept(frame.sigma, from, out.camera, stride, 1);
  out.confidence = kept(frame.confidence, from, out.camera, stride, 1);
  out.color_sigma = frame.color_sigma;
  out.color = kept(frame.color, from, out.camera, stride, 3);
  return out;
}

}  // namespace ppm
