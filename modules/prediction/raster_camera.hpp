#pragma once
#include "framework/slam/prediction.hpp"
#include "modules/prediction/raster_kernels.hpp"

namespace ppm {

/// The camera of a view, for kernels. Draws all rows; cull: see RasterCamera. The image has fewer than 2^15 columns and
/// rows and fewer than 2^24 pixels (InternalError).
RasterCamera raster_camera(const Camera& camera, const Pose& T_map_camera, bool cull);

}  // namespace ppm
