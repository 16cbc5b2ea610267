#include "framework/slam/pose_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ppm {

std::vector<PoseCluster> pose_clusters(std::span<const Pose> poses, std::span<const double> weights, double distance_m,
                                       double angle_rad) {
  std::vector<std::size_t> order(poses.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
  // The angle between two rotations is within a limit where the trace of one's inverse times the other is above this.
  const double least_trace = 1 + 2 * std::cos(angle_rad);
  auto near = [&](const Pose& a, const Pose& b) {
    return (a.translation() - b.translation()).squaredNorm() <= distance_m * distance_m &&
           a.linear().cwiseProduct(b.linear()).sum() >= least_trace;
  };
  std::vector<PoseCluster> clusters;
  for (std::size_t i : order) {
    const auto found = std::ranges::find_if(clusters, [&](const PoseCluster& c) { return near(poses[c.leader], poses[i]); });
    if (found != clusters.end())
      found->weight += weights[i];
    else if (weights[i] > 0)
      clusters.push_back({i, weights[i]});
  }
  return clusters;
}

}  // namespace ppm
