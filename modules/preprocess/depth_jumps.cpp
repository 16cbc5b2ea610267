#include "modules/preprocess/depth_jumps.hpp"

#include <Eigen/Core>
#include <cmath>

#include "modules/preprocess/row_bands.hpp"

namespace ppm {
namespace {

/// Compares neighbours of one frame.
class Neighbours {
 public:
  Neighbours(const Frame& frame, const JumpSettings& settings)
      : frame_(frame),
        cos2_(static_cast<float>(std::pow(std::cos(settings.angle_least), 2))),
        sigmas2_(static_cast<float>(settings.noise_sigmas * settings.noise_sigmas)) {
    for (int x = 0; x < frame.camera.cols; ++x)
      u_.push_back(static_cast<float>((x - frame.camera.cx) / frame.camera.fx));
    for (int y = 0; y < frame.camera.rows; ++y)
      v_.push_back(static_cast<float>((y - frame.camera.cy) / frame.camera.fy));
  }

  Step between(int x, int y, int x2, int y2) const {
    const auto p = at(x, y), q = at(x2, y2);
    const float zp = frame_.depth[p], zq = frame_.depth[q], dz = zq - zp;
    if (std::isnan(dz)) return Step::unknown;
    const float variance = frame_.sigma[p] * frame_.sigma[p] + frame_.sigma[q] * frame_.sigma[q];
    if (dz * dz <= sigmas2_ * variance) return Step::none;
    const Eigen::Vector3f a = zp * ray(x, y), b = zq * ray(x2, y2), chord = b - a, sight = a + b;
    const float along = chord.dot(sight);
    if (along * along <= cos2_ * chord.squaredNorm() * sight.squaredNorm()) return Step::none;
    return along > 0 ? Step::farther : Step::closer;
  }
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * frame_.camera.cols + x); }

 private:
  Eigen::Vector3f ray(int x, int y) const {
    return {u_[static_cast<std::size_t>(x)], v_[static_cast<std::size_t>(y)], 1};
  }

  const Frame& frame_;
  float cos2_, sigmas2_;
  std::vector<float> u_, v_;
};

}  // namespace

DepthJumps depth_jumps(const Frame& frame, const JumpSettings& settings, const Workers& workers) {
  const Neighbours neighbours(frame, settings);
  const int cols = frame.camera.cols, rows = frame.camera.rows;
  DepthJumps jumps;
  jumps.right.assign(frame.depth.size(), Step::unknown);
  jumps.down.assign(frame.depth.size(), Step::unknown);
  for_row_bands(workers, rows, cols, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < cols; ++x) {
        const auto p = neighbours.at(x, y);
        if (x + 1 < cols) jumps.right[p] = neighbours.between(x, y, x + 1, y);
        if (y + 1 < rows) jumps.down[p] = neighbours.between(x, y, x, y + 1);
      }
  });
  return jumps;
}

}  // namespace ppm
