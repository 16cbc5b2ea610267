#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "framework/core/parallel.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/slam/true_surface.hpp"

namespace ppm {

/// Points of the true surface that the mapped images of a source (open) up to image `last` saw, world frame, about one a
/// square centimetre: where the rays of the pixels that have a return truly end, from the reference poses; the first of them in each
/// voxel of 1 cm. At most 100 images, evenly, are looked at. Nothing where no image has a reference pose. The same points, in
/// the same order, for any number of workers. Throws DataError.
std::vector<Eigen::Vector3f> seen_surface(const TrueSurface& truth, const FrameSource& source, std::int64_t last,
                                          const Workers& workers);

}  // namespace ppm
