#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/core/parallel.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/slam/reprojection.hpp"
#include "framework/slam/trajectory.hpp"

namespace ppm {

/// Which images of a run are compared with each other.
struct RevisitSettings {
  enum class Gap { at_least, exactly } form = Gap::at_least;
  std::int64_t gap = 150;     ///< between the two images of a pair, in the source's own numbers of images
  std::size_t images = 100;   ///< at most so many, evenly over the path, are looked at (exactly: so many, each with its pair)
  std::size_t pairs = 200;    ///< at most so many of the pairs that overlap, evenly over all of them
  double overlap = 0.3;       ///< of each image with the other, see overlap()
};

/// How well the images of a place agree that was seen at different times, with the poses of a path: the measure of a path
/// that needs no reference, neither poses nor surface.
/// path: poses of images of the source (open), matched by stamp. Reads the images at full resolution. Nothing where
/// no place is seen twice so far apart. The same numbers for any number of workers. Throws DataError.
std::optional<ReprojectionError> score_revisits(const std::vector<StampedPose>& path, const FrameSource& source,
                                                const RevisitSettings& settings, const Workers& workers);

}  // namespace ppm
