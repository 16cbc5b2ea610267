#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "framework/core/se3.hpp"

namespace ppm {

/// Poses that say about the same, and how much weight they have together.
struct PoseCluster {
  std::size_t leader = 0;  ///< its pose with the largest weight
  double weight = 0;       ///< of all its poses
};

/// Groups poses around those with the largest weights: going down the weights (the lower index first among equals), a pose
/// joins the first leader that is near, or becomes one. Clusters are in the order of their leaders' weights.
/// weights: not negative; a pose without weight joins, but leads none. Near: within distance_m and angle_rad.
/// Source: Hartigan, "Clustering Algorithms", 1975, section 3 (quick partition, leader algorithm).
std::vector<PoseCluster> pose_clusters(std::span<const Pose> poses, std::span<const double> weights, double distance_m,
                                       double angle_rad);

}  // namespace ppm
