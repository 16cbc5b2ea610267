#include "modules/maps/vdb/depth_bounds.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace ppm {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr DepthBounds::Bounds kNone{kInf, kInf, -kInf};

void unite(DepthBounds::Bounds& a, const DepthBounds::Bounds& b) {
  a.free = std::min(a.free, b.free);
  a.measured_free = std::min(a.measured_free, b.measured_free);
  a.end = std::max(a.end, b.end);
}

}  // namespace

void DepthBounds::build(const PixelProfiles& profiles) {
  int cols = profiles.camera.cols, rows = profiles.camera.rows;
  levels_.resize(static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(std::max(cols, rows)) - 1)) + 1);
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    level.cols = cols;
    level.rows = rows;
    level.bounds.assign(static_cast<std::size_t>(cols * rows), kNone);
    if (l == 0) {
      for (std::size_t i = 0; i < level.bounds.size(); ++i) {
        const auto& p = profiles.pixel[i];
        level.bounds[i] = {p.free, p.end == -kInf ? kInf : p.free, p.end};
      }
    } else {
      const Level& below = levels_[l - 1];
      for (int y = 0; y < below.rows; ++y)
        for (int x = 0; x < below.cols; ++x)
          unite(level.bounds[static_cast<std::size_t>((y / 2) * cols + x / 2)],
                below.bounds[static_cast<std::size_t>(y * below.cols + x)]);
    }
    cols = (cols + 1) / 2;
    rows = (rows + 1) / 2;
  }
}

DepthBounds::Bounds DepthBounds::of(const PixelRect& r) const {
  const int longest = std::max(r.x1 - r.x0, r.y1 - r.y0);
  const int l = std::bit_width(static_cast<unsigned>(longest));  // so that the rectangle meets two squares a side at most
  const Level& level = levels_[static_cast<std::size_t>(l)];
  Bounds bounds = kNone;
  for (int y = r.y0 >> l; y <= r.y1 >> l; ++y)
    for (int x = r.x0 >> l; x <= r.x1 >> l; ++x) unite(bounds, level.bounds[static_cast<std::size_t>(y * level.cols + x)]);
  return bounds;
}

}  // namespace ppm
