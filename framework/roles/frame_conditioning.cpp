#include "framework/roles/frame_conditioning.hpp"

#include <cmath>
#include <limits>

#include "framework/core/error.hpp"
#include "framework/slam/decimate.hpp"

namespace ppm {

double FrameConditioning::sigma(double depth_m) const {
  const double beyond = depth_m - sigma_near;
  return sigma_floor + sigma_quadratic * beyond * beyond;
}

Frame FrameConditioning::apply(const Frame& image, int stride) const {
  const auto pixels = static_cast<std::size_t>(image.camera.pixels());
  PPM_CHECK(image.depth.size() == pixels, "frame {}: {} pixels, {} depths", image.index, pixels, image.depth.size());
  Frame out = decimated(image, stride);
  out.camera = correction.camera(image.camera).decimated(stride);
  correct_depth(correction, out);
  out.lateral_px = static_cast<float>(sigma_lateral / stride);
  out.color_sigma = static_cast<float>(sigma_color);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const bool has_sigma = !image.sigma.empty();
  out.sigma.resize(out.depth.size());
  for (std::size_t p = 0; p < out.depth.size(); ++p) {
    const float depth = out.depth[p];
    const bool valid = depth >= min_range_m && depth <= max_range_m;  // false for NaN
    if (!valid)
      out.depth[p] = out.sigma[p] = nan;
    else if (!has_sigma)
      out.sigma[p] = static_cast<float>(sigma(depth));
  }
  return out;
}

}  // namespace ppm
