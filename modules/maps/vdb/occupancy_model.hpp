#pragma once
#include <vector>

#include "framework/slam/frame.hpp"
#include "modules/maps/vdb/vdb_map.hpp"

namespace ppm {

/// What a measurement says about the voxels along its ray.
enum class OccupancyForm {
  profile,  ///< a ramp from free to occupied through the measured range, as wide as the sensor is unsure
  literal,  ///< OctoMap's: a hit for the voxel that holds the point, a miss for those before it
};

struct OccupancySettings {
  OccupancyForm form = OccupancyForm::profile;
  float log_odds_hit = 0.84729786f;    ///< of occupied, by one measurement; probability 0.7
  float log_odds_miss = -0.40546511f;  ///< of free space, by one measurement; probability 0.4
  double width_sigmas = 2;           ///< half width of the ramp: so many standard deviations of the range ...
  double width_voxels = 1.5;         ///< ... at least so many voxels
  double thickness_voxels = 2;       ///< what lies farther behind the measured range stays as it is
  double memory = 100;           ///< frames after which evidence has faded to 1/e; 0 = never
  double max_range_m = 100;
};

/// What a frame's pixels say, for all poses it may have been taken from and all maps with the same voxels.
/// Log-odds that a pixel gives to a voxel whose centre lies at depth Z on its ray, in codes (VdbMap::step()):
/// slope * (Z - depth), between `miss` and `hit`, as far as `end`.
/// Source: the inverse sensor model that is linear in log-odds around the surface is that of Funk et al.,
/// "Multi-Resolution 3D Mapping With Explicit Free Space Representation for Fast and Accurate Mobile Robot Motion
/// Planning", IEEE Robotics and Automation Letters 2021, which simplifies Loop et al., "A Closed-Form Bayesian Fusion
/// Equation Using Occupancy Probabilities", 3DV 2016.
struct PixelProfiles {
  struct Pixel {  // four floats in this order: look_at_leaf() reads them
    float depth;  ///< m along the optical axis
    float slope;  ///< codes / m
    float end;    ///< m: nothing is said of what is deeper; -inf without a measurement
    float free;   ///< m: what is not deeper gets the whole `miss`; -inf without a measurement
  };
  Camera camera;
  std::vector<Pixel> pixel;  ///< [rows*cols]
  float hit = 0, miss = 0;   ///< codes
  float keep = 1;            ///< share of a voxel's log-odds that stays when it is written

  /// map: for its voxels and the size of its codes.
  void build(const Frame& frame, const VdbMap& map, const OccupancySettings& settings);
};

}  // namespace ppm
