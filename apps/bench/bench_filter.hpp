#pragma once
#include <string>
#include <vector>

#include "apps/bench/bench_world.hpp"

namespace ppm {

/// A filter that is to be timed: nodes in the order of a frame; an empty module name leaves a node out. Parameters as
/// in a graph file: "{stride: 2}".
struct BenchFilter {
  int particles = 1;
  bool own_maps = false;  ///< each particle starts with a map of its own; otherwise all share one
  bool clones = false;    ///< the maps of the frame before are kept, so that all that an update writes is cloned
  std::string look, look_params = "{}";
  std::string weigh, weigh_params = "{}";
  double ess_below = 0;  ///< of resampling
  std::string view;      ///< an exact view for the update, where the look is none
  std::string update, update_params = "{}";
  int update_every = 1;  ///< frames; the view too
  int threads = 1;
  /// Noise of the views' poses about the images'.
  std::string jitter = "{sigma_t: 2 cm, sigma_r: 1 deg}";
};

/// What a filter cost.
struct BenchTimes {
  double wall_s = 0;       ///< of the timed nodes, over the measured frames
  double cpu_s = 0;        ///< of the process, over the same frames, all nodes
  int frames = 0;          ///< that were measured
  double ancestors = 1;    ///< share of particles that resampling let live, on average
  double faces_added = 0;  ///< by all updates together, a particle and frame
};

/// Runs the filter through the executor for some turns of the world's cycle of images, the first for warming up. nodes:
/// which of "look", "weigh", "pick", "view" and "update" are timed. Throws what the modules throw.
BenchTimes run_filter(const Registry& registry, BenchWorld& world, const BenchFilter& filter,
                      const std::vector<std::string>& nodes);

}  // namespace ppm
