#pragma once
#include <cstdint>
#include <vector>

#include "framework/core/se3.hpp"
#include "framework/slam/camera.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// A chunk that a view may show, and where.
struct VisibleChunk {
  std::uint32_t chunk = 0;
  float distance = 0;                       ///< m, from the camera's centre to the nearest point of the chunk's box
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;  ///< pixels whose rays may meet the box, both ends included
  bool meets(int left, int top, int right, int bottom) const {
    return x0 <= right && x1 >= left && y0 <= bottom && y1 >= top;
  }
};

/// The chunks with faces whose box meets the view, nearest first (equal distances: lower number first). Never too few.
std::vector<VisibleChunk> visible_chunks(const PpmMap& map, const Camera& camera, const Pose& T_map_camera);

/// The chunks with faces whose box meets the image, grown by a pixel on every side, ascending: also those that lie
/// between the rays of pixels, which no ray can meet.
std::vector<std::uint32_t> chunks_in_image(const PpmMap& map, const Camera& camera, const Pose& T_map_camera);

}  // namespace ppm
