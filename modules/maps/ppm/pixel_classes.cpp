#include "modules/maps/ppm/pixel_classes.hpp"

namespace ppm {
namespace {

bool fits_neighbour(const UpdateView& view, const SurfaceGate& gate, float gate_sigmas,
                    const std::vector<std::uint8_t>& gone, int x, int y) {
  const auto p = view.at(x, y);
  for (int v = std::max(0, y - 1); v <= std::min(view.rows() - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(view.cols() - 1, x + 1); ++u) {
      const auto q = view.at(u, v);
      if (q == p || !view.prediction->hit(q) || (!gone.empty() && gone[q])) continue;
      if (std::abs(surface_distance(view, gate, p, q)) <= gate_sigmas) return true;
    }
  return false;
}

/// One pass of a running minimum or maximum of width 2 radius + 1 along a line, by counting set entries in the window.
/// all: set where all entries of the window are set (those beyond the line count as set), else where any is.
void slide(const std::uint8_t* in, std::uint8_t* out, int n, int step, int radius, bool all) {
  int set = 0, seen = 0;
  for (int i = 0; i < std::min(radius, n); ++i) set += in[i * step], ++seen;
  for (int i = 0; i < n; ++i) {
    if (i + radius < n) set += in[(i + radius) * step], ++seen;
    if (i - radius - 1 >= 0) set -= in[(i - radius - 1) * step], --seen;
    out[i * step] = all ? set == seen : set > 0;
  }
}

void slide_both(int cols, int rows, int radius, bool all, std::vector<std::uint8_t>& mask) {
  std::vector<std::uint8_t> half(mask.size());
  for (int y = 0; y < rows; ++y)
    slide(&mask[static_cast<std::size_t>(y * cols)], &half[static_cast<std::size_t>(y * cols)], cols, 1, radius, all);
  for (int x = 0; x < cols; ++x)
    slide(&half[static_cast<std::size_t>(x)], &mask[static_cast<std::size_t>(x)], rows, cols, radius, all);
}

}  // namespace

float surface_distance(const UpdateView& view, const SurfaceGate& gate, std::size_t p, std::size_t q) {
  const float along = view.normal[q].dot(view.point[p]);
  const float cosine = std::abs(along) / view.point[p].norm();
  return (along - view.offset[q]) / gate.spread(view.sigma[p], cosine, view.prediction->variance[q]);
}

void classify_pixels(const UpdateView& view, const SurfaceGate& gate, float gate_sigmas,
                     const std::vector<std::uint8_t>& gone, const Workers& workers,
                     std::vector<std::uint8_t>& classes) {
  classes.assign(view.depth.size(), 0);
  for_each_row(workers, view.rows(), [&](int y) {
    for (int x = 0; x < view.cols(); ++x) {
      const auto p = view.at(x, y);
      if (!view.measured(p)) continue;
      std::uint8_t c = 0;
      if (view.prediction->hit(p) && (gone.empty() || !gone[p])) {
        const float distance = surface_distance(view, gate, p, p);
        c = std::abs(distance) <= gate_sigmas ? kOwnHit | kExplained : distance > 0 ? kInFront : kBehind;
      }
      if (!(c & kExplained) && fits_neighbour(view, gate, gate_sigmas, gone, x, y)) c |= kExplained;
      if (!(c & (kExplained | kBehind))) c |= kWanted;
      classes[p] = c;
    }
  });
}

void open_mask(int cols, int rows, int radius, const std::vector<std::uint8_t>& ignored,
               std::vector<std::uint8_t>& mask) {
  std::vector<std::uint8_t> core = mask;
  for (std::size_t p = 0; p < core.size(); ++p) core[p] |= ignored[p];
  slide_both(cols, rows, radius, true, core);
  slide_both(cols, rows, radius, false, core);
  for (std::size_t p = 0; p < core.size(); ++p) mask[p] &= core[p];
}

void dilate_mask(int cols, int rows, int radius, std::vector<std::uint8_t>& mask) {
  slide_both(cols, rows, radius, false, mask);
}

}  // namespace ppm
