#include "modules/maps/ppm/texel_bend.hpp"

#include <cmath>

#include "modules/maps/ppm/texel_grid.hpp"

namespace ppm {
namespace {

/// Errors of texels against the plane through the offsets of the face's corners.
class Bends {
 public:
  Bends(std::uint32_t n, const TexelView& texels)
      : n_(n),
        texels_(texels),
        at_(texels.mean[0]),
        along_i_((texels.mean[texel_index(n, n, 0)] - at_) / static_cast<float>(n)),
        along_j_((texels.mean[n] - at_) / static_cast<float>(n)) {}

  float raw(std::uint32_t i, std::uint32_t j) const {
    return texels_.mean[texel_index(n_, i, j)] - at_ - along_i_ * static_cast<float>(i) -
           along_j_ * static_cast<float>(j);
  }

  /// Averaged over the texel and those around it, by information, without the corners: their error is 0 by definition.
  float smooth(std::uint32_t i, std::uint32_t j) const {
    float sum = 0, weight = 0;
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
      if (a > n_ || b > n_ || a + b > n_ || is_corner(a, b)) return;  // unsigned: -1 is beyond too
      const float w = 1 / texels_.variance[texel_index(n_, a, b)];
      sum += w * raw(a, b);
      weight += w;
    };
    add(i, j);
    add(i + 1, j);
    add(i - 1, j);
    add(i, j + 1);
    add(i, j - 1);
    add(i + 1, j - 1);
    add(i - 1, j + 1);
    return sum / weight;
  }

  bool is_corner(std::uint32_t i, std::uint32_t j) const { return i == n_ || j == n_ || i + j == 0; }

 private:
  std::uint32_t n_;
  const TexelView& texels_;
  float at_, along_i_, along_j_;
};

}  // namespace

std::optional<TexelBend> largest_bend(std::uint32_t n, const TexelView& texels, const BendSettings& settings) {
  const Bends bends(n, texels);
  std::optional<TexelBend> largest;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; i + j <= n; ++j) {
      const bool on_side = i == 0 || j == 0 || i + j == n;
      if (settings.bend ? bends.is_corner(i, j) : on_side) continue;
      const float mean = texels.mean[texel_index(n, i, j)], sigma = std::sqrt(texels.variance[texel_index(n, i, j)]);
      if (sigma > settings.sigma_most) continue;
      const float error = settings.bend ? bends.smooth(i, j) : mean;
      if (std::abs(error) <= std::max(settings.least, settings.sigmas * sigma)) continue;
      if (!largest || std::abs(error) > std::abs(largest->error)) largest = TexelBend{i, j, error, mean};
    }
  return largest;
}

}  // namespace ppm
