#include "framework/slam/still_pixels.hpp"

#include "framework/core/error.hpp"

namespace ppm {
namespace {

void check_alike(const std::vector<Frame>& frames) {
  PPM_CHECK(frames.size() >= 2, "{} images: repeatability takes at least 2", frames.size());
  for (const auto& f : frames) {
    if (f.camera != frames.front().camera)
      throw DataError("the still images", f.index, "has another camera than the first of its place");
    if (f.confidence.empty() != frames.front().confidence.empty())
      throw DataError("the still images", f.index,
                      "has a confidence where the first of its place has none, or the reverse");
  }
}

StillPixel statistics(const std::vector<Frame>& frames, std::size_t p, double range_per_depth) {
  const auto n = static_cast<double>(frames.size());
  double range = 0, amplitude = 0, squares = 0;
  for (const auto& f : frames) {
    range += f.depth[p] * range_per_depth / n;
    if (!f.confidence.empty()) amplitude += f.confidence[p] / n;
  }
  StillPixel pixel;
  for (const auto& f : frames) {
    const double off = f.depth[p] * range_per_depth - range;
    pixel.deviation.push_back(static_cast<float>(off));
    squares += off * off;
  }
  pixel.range = static_cast<float>(range);
  pixel.amplitude = static_cast<float>(amplitude);
  pixel.variance = static_cast<float>(squares / (n - 1));
  return pixel;
}

}  // namespace

std::vector<StillPixel> still_pixels(const std::vector<Frame>& frames, int group) {
  check_alike(frames);
  const Camera& camera = frames.front().camera;
  std::vector<StillPixel> pixels;
  for (int y = 0, i = 0; y < camera.rows; ++y)
    for (int x = 0; x < camera.cols; ++x, ++i) {
      bool always = true;
      for (const auto& f : frames) always &= f.valid(i);
      if (!always) continue;
      pixels.push_back(statistics(frames, static_cast<std::size_t>(i), camera.ray(x, y).norm()));
      pixels.back().group = group;
    }
  return pixels;
}

}  // namespace ppm
