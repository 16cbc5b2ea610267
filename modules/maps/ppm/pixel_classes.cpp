#include "modules/maps/ppm/pixel_classes.hpp"

namespace ppm {
namespace {

/// Squared distance that still fits, m^2, for a point at `along` a surface's normal from the camera. range2: its
/// squared range, m^2.
float squared_limit(const SurfaceGate& gate, float gate_sigmas, float sigma, float along, float range2,
                    float variance) {
  const float cosine2 = std::max(along * along / range2, gate.least_cosine * gate.least_cosine);
  return gate_sigmas * gate_sigmas *
         (sigma * sigma * cosine2 + gate.pose_sigma * gate.pose_sigma +
          std::min(variance, gate.map_sigma_most * gate.map_sigma_most));
}

bool fits_neighbour(const UpdateView& view, const SurfaceGate& gate, float gate_sigmas,
                    const std::vector<std::uint8_t>& gone, int x, int y) {
  const auto p = view.at(x, y);
  const float range2 = view.point[p].squaredNorm();
  for (int v = std::max(0, y - 1); v <= std::min(view.rows() - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(view.cols() - 1, x + 1); ++u) {
      const auto q = view.at(u, v);
      if (q == p || !view.prediction->hit(q) || (!gone.empty() && gone[q])) continue;
      const float along = view.normal[q].dot(view.point[p]), off = along - view.offset[q];
      if (off * off <= squared_limit(gate, gate_sigmas, view.sigma[p], along, range2, view.prediction->variance[q]))
        return true;
    }
  return false;
}

/// Combines each entry of a line with those up to `radius` before and after it: all of them set, or any. Beyond the
/// line counts as what changes nothing.
void slide_along(std::uint8_t* line, int n, int radius, bool all, std::vector<std::uint8_t>& padded) {
  padded.assign(static_cast<std::size_t>(n + 2 * radius), all);
  std::copy_n(line, n, padded.begin() + radius);
  std::copy_n(padded.begin(), n, line);
  for (int k = 1; k <= 2 * radius; ++k) {
    const std::uint8_t* const shifted = padded.data() + k;
    if (all)
      for (int i = 0; i < n; ++i) line[i] &= shifted[i];
    else
      for (int i = 0; i < n; ++i) line[i] |= shifted[i];
  }
}

/// The same over columns, a row at a time. in, out: [rows*cols], distinct.
void slide_across(int cols, int rows, int radius, bool all, const std::uint8_t* in, std::uint8_t* out) {
  for (int y = 0; y < rows; ++y) {
    std::uint8_t* const line = out + y * cols;
    std::fill_n(line, cols, static_cast<std::uint8_t>(all));
    for (int v = std::max(0, y - radius); v <= std::min(rows - 1, y + radius); ++v) {
      const std::uint8_t* const other = in + v * cols;
      if (all)
        for (int x = 0; x < cols; ++x) line[x] &= other[x];
      else
        for (int x = 0; x < cols; ++x) line[x] |= other[x];
    }
  }
}

void slide_both(int cols, int rows, int radius, bool all, std::vector<std::uint8_t>& mask) {
  std::vector<std::uint8_t> padded, whole(mask.size());
  for (int y = 0; y < rows; ++y) slide_along(mask.data() + y * cols, cols, radius, all, padded);
  slide_across(cols, rows, radius, all, mask.data(), whole.data());
  mask.swap(whole);
}

}  // namespace

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
        const float along = view.normal[p].dot(view.point[p]), off = along - view.offset[p];
        const float limit2 = squared_limit(gate, gate_sigmas, view.sigma[p], along, view.point[p].squaredNorm(),
                                           view.prediction->variance[p]);
        c = off * off <= limit2 ? kOwnHit | kExplained : off > 0 ? kInFront : kBehind;
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
