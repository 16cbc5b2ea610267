#include "framework/roles/frame_conditioning.hpp"

#include <cmath>
#include <limits>

#include "framework/core/error.hpp"

namespace ppm {

double FrameConditioning::sigma(double depth_m) const {
  const double beyond = depth_m - sigma_near;
  return sigma_floor + sigma_quadratic * beyond * beyond;
}

Frame FrameConditioning::apply(const Frame& image, int stride) const {
  const auto pixels = static_cast<std::size_t>(image.camera.pixels());
  PPM_CHECK(image.depth.size() == pixels && (image.sigma.empty() || image.sigma.size() == pixels) &&
                (image.confidence.empty() || image.confidence.size() == pixels) &&
                (image.color.empty() || image.color.size() == 3 * pixels),
            "frame {}: {} pixels, {} depths, {} sigmas, {} confidences, {} colour bytes", image.index, pixels,
            image.depth.size(), image.sigma.size(), image.confidence.size(), image.color.size());
  Frame out;
  out.index = image.index;
  out.stamp_s = image.stamp_s;
  out.camera = image.camera.decimated(stride);
  out.T_base_camera = image.T_base_camera;
  out.T_world_camera_ref = image.T_world_camera_ref;
  out.lateral_px = static_cast<float>(sigma_lateral / stride);
  const auto kept = static_cast<std::size_t>(out.camera.pixels());
  out.depth.reserve(kept);
  out.sigma.reserve(kept);
  if (!image.confidence.empty()) out.confidence.reserve(kept);
  if (!image.color.empty()) out.color.reserve(3 * kept);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (int y = 0; y < out.camera.rows; ++y) {
    for (int x = 0; x < out.camera.cols; ++x) {
      const auto p = static_cast<std::size_t>(stride * y * image.camera.cols + stride * x);
      const float depth = image.depth[p];
      const bool valid = depth >= min_range_m && depth <= max_range_m;  // false for NaN
      out.depth.push_back(valid ? depth : nan);
      out.sigma.push_back(!valid ? nan : image.sigma.empty() ? static_cast<float>(sigma(depth)) : image.sigma[p]);
      if (!image.confidence.empty()) out.confidence.push_back(image.confidence[p]);
      if (!image.color.empty()) out.color.insert(out.color.end(), &image.color[3 * p], &image.color[3 * p] + 3);
    }
  }
  return out;
}

}  // namespace ppm
