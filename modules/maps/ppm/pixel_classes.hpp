#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "modules/maps/ppm/update_view.hpp"

namespace ppm {

/// How far a measurement may lie from a surface, along the surface's normal, and still be of it.
struct SurfaceGate {
  float pose_sigma = 0.008f;     ///< m, what the pose's error and the map's own bias add
  float map_sigma_most = 0.01f;  ///< m, the most that an uncertain texel widens the gate
  float least_cosine = 0.3f;     ///< at grazing angles the sensor's noise counts as at this cosine

  /// One standard deviation. sigma: of the depth, m; cosine: |normal . line of sight|; variance: of the map along the
  /// normal.
  float spread(float sigma, float cosine, float variance) const {
    const float s = sigma * std::max(cosine, least_cosine);
    return std::sqrt(s * s + pose_sigma * pose_sigma + std::min(variance, map_sigma_most * map_sigma_most));
  }
};

/// What a pixel says of the map. Two questions are kept apart: "explained" (a surface predicted in the 3x3
/// neighbourhood fits) decides where new surface may start, "own hit" (this pixel's surface fits) decides overlap,
/// texels and votes.
enum PixelClass : std::uint8_t {
  kOwnHit = 1,
  kExplained = 2,
  kInFront = 4,  ///< measured in front of this pixel's surface: something new, or it moved there
  kBehind = 8,   ///< measured behind it: the surface is seen through
  kWanted = 16,  ///< measured, unexplained, not behind: candidate for new surface
};

/// Classes of all pixels [px]: 0 without a measurement. gate_sigmas: how many spreads still fit.
/// gone: pixels [px] whose predicted face was deleted count as misses; empty = none.
void classify_pixels(const UpdateView& view, const SurfaceGate& gate, float gate_sigmas,
                     const std::vector<std::uint8_t>& gone, const Workers& workers, std::vector<std::uint8_t>& classes);

/// Removes the parts of a mask that are thinner than 2 radius + 1 pixels (erosion, then dilation, by a square). Pixels
/// of `ignored` (set = neither inside nor outside) do not make their surroundings thin. Pixels beyond the image do not
/// either. Entries: 0 and 1.
void open_mask(int cols, int rows, int radius, const std::vector<std::uint8_t>& ignored,
               std::vector<std::uint8_t>& mask);

/// Grows a mask by a square of the radius.
void dilate_mask(int cols, int rows, int radius, std::vector<std::uint8_t>& mask);

}  // namespace ppm
