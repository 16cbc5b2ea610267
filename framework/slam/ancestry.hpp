#pragma once
#include <cstddef>
#include <vector>

#include "framework/slam/trajectory.hpp"

namespace ppm {

/// The tree that the particles' paths make: what they share is its trunk. A path keeps its own past alone, so the poses in
/// memory are exactly those of the minimal tree: the ones that some particle descends from.
/// Source: Jacob, Murray, Rubenthaler, "Path storage in the particle filter", Statistics and Computing 2015.
struct Ancestry {
  std::size_t nodes = 0;       ///< poses in the tree, each once
  std::size_t depth = 0;       ///< poses of the longest path
  std::size_t branchings = 0;  ///< poses from which more than one path goes on
  /// Frames, and seconds, since the last pose that all paths share; back to the first frame where they share none.
  std::size_t coalescence_frames = 0;
  double coalescence_s = 0;
};

/// Walks back to the last common pose alone: the work is bounded by the part of the tree behind it.
Ancestry ancestry(const std::vector<Trajectory>& paths);

}  // namespace ppm
