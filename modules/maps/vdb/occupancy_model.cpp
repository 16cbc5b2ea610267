#include "modules/maps/vdb/occupancy_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ppm {

void PixelProfiles::build(const Frame& frame, const VdbMap& map, const OccupancySettings& settings) {
  constexpr float kNothing = -std::numeric_limits<float>::infinity();
  camera = frame.camera;
  hit = settings.log_odds_hit / map.step();
  miss = settings.log_odds_miss / map.step();
  keep = settings.memory > 0 ? static_cast<float>(std::exp(-1 / settings.memory)) : 1.f;
  const double h = map.settings().voxel_size_m;
  pixel.resize(static_cast<std::size_t>(camera.pixels()));
  for (int y = 0, i = 0; y < camera.rows; ++y)
    for (int x = 0; x < camera.cols; ++x, ++i) {
      Pixel& p = pixel[static_cast<std::size_t>(i)];
      p = {0, 0, kNothing, kNothing};
      if (!frame.valid(i)) continue;
      const double along = camera.ray(x, y).norm();  // range = along * depth
      const double depth = frame.depth[static_cast<std::size_t>(i)];
      const double far = settings.max_range_m / along;
      if (depth > far) {  // free up to there, and no more
        p = {std::numeric_limits<float>::max(), 1.f, static_cast<float>(far), static_cast<float>(far)};
        continue;
      }
      const double sigma = along * frame.sigma[static_cast<std::size_t>(i)];
      const double width = std::max(settings.width_sigmas * sigma, settings.width_voxels * h) / along;
      p.depth = static_cast<float>(depth);
      p.slope = static_cast<float>(0.5 * (hit - miss) / width);
      p.end = static_cast<float>(depth + std::max(settings.thickness_voxels * h / along, width));
      p.free = static_cast<float>(depth + miss / p.slope);
    }
}

}  // namespace ppm
