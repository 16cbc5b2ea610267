#include "modules/preprocess/depth_jumps.hpp"

#include <cmath>

#include "modules/preprocess/row_bands.hpp"

namespace ppm {
namespace {

/// A line of pixels: depth, sigma and the rays (u, v, 1), v the same for all.
struct Line {
  const float *depth, *sigma, *u;
  float v;
};

/// Compares n pixels of one line with those of another. Without branches, so that the loop is vectorised.
void compare(const Line& a, const Line& b, int n, float cos2, float sigmas2, Step* out) {
  for (int i = 0; i < n; ++i) {
    const float za = a.depth[i], zb = b.depth[i], dz = zb - za;
    const float xa = za * a.u[i], xb = zb * b.u[i], ya = za * a.v, yb = zb * b.v;
    const float dx = xb - xa, dy = yb - ya, sx = xa + xb, sy = ya + yb, sz = za + zb;
    const float along = dx * sx + dy * sy + dz * sz;  // chord . sight
    const float chord2 = dx * dx + dy * dy + dz * dz, sight2 = sx * sx + sy * sy + sz * sz;
    const float noise2 = sigmas2 * (a.sigma[i] * a.sigma[i] + b.sigma[i] * b.sigma[i]);
    const int jump = (dz * dz > noise2) & (along * along > cos2 * chord2 * sight2);
    const int sign = along > 0 ? jump : -jump;
    out[i] = static_cast<Step>(dz == dz ? sign : static_cast<int>(Step::unknown));
  }
}

}  // namespace

DepthJumps depth_jumps(const Frame& frame, const JumpSettings& settings, const Workers& workers) {
  const Camera& camera = frame.camera;
  const int cols = camera.cols, rows = camera.rows;
  const auto cos2 = static_cast<float>(std::pow(std::cos(settings.angle_least), 2));
  const auto sigmas2 = static_cast<float>(settings.noise_sigmas * settings.noise_sigmas);
  std::vector<float> u;
  for (int x = 0; x < cols; ++x) u.push_back(static_cast<float>((x - camera.cx) / camera.fx));
  auto line = [&](int x, int y) {
    const auto p = static_cast<std::size_t>(y * cols + x);
    return Line{&frame.depth[p], &frame.sigma[p], &u[static_cast<std::size_t>(x)],
                static_cast<float>((y - camera.cy) / camera.fy)};
  };
  DepthJumps jumps;
  jumps.right.assign(frame.depth.size(), Step::unknown);
  jumps.down.assign(frame.depth.size(), Step::unknown);
  for_row_bands(workers, rows, cols, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const auto p = static_cast<std::size_t>(y * cols);
      if (cols > 1) compare(line(0, y), line(1, y), cols - 1, cos2, sigmas2, &jumps.right[p]);
      if (y + 1 < rows) compare(line(0, y), line(0, y + 1), cols, cos2, sigmas2, &jumps.down[p]);
    }
  });
  return jumps;
}

}  // namespace ppm
