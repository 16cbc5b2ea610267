#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "framework/core/se3.hpp"

namespace octomap {
class OcTree;
class OcTreeNode;
}  // namespace octomap

namespace ppm {

/// A cell of an octree at its finest resolution, as OctoMap's keys: 2^15 at the origin.
using OctomapCell = std::array<std::uint16_t, 3>;

/// Looks up the nodes of one tree. Keeps the path to the last one: neighbours share most of it.
class OctomapLookup {
 public:
  explicit OctomapLookup(const octomap::OcTree& tree);
  /// The leaf that holds a cell, as OcTree::search; null where nothing is known.
  const octomap::OcTreeNode* leaf(const OctomapCell& cell);
  /// Log odds of a cell; 0 where nothing is known.
  double log_odds(const OctomapCell& cell);

 private:
  static constexpr int kDepth = 16;
  const octomap::OcTree* tree_;
  std::array<const octomap::OcTreeNode*, kDepth + 1> path_{};  // root .. deepest node
  int region_ = 0;                                              // depth of the cube of cells that leaf_ is the answer for
  OctomapCell last_{};
  const octomap::OcTreeNode* leaf_ = nullptr;
};

/// Where a ray meets the first occupied cell.
struct OctomapHit {
  OctomapCell cell;
  double enters_m = 0;  ///< range where it enters the cell
  double leaves_m = 0;  ///< range where it leaves the last occupied cell of the run that begins there
};

/// OcTree::castRay with ignored unknown cells, to the same cell by the same arithmetic, but for one thing: the cell that the
/// origin is in is no hit. Several times as fast, because it looks up a node once and not once a cell.
/// direction: unit. range_most_m: of a cell's centre. Throws nothing; a ray that leaves the tree's space hits nothing.
std::optional<OctomapHit> cast_ray(const octomap::OcTree& tree, OctomapLookup& lookup, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction, double range_most_m);

/// Centre of a cell, m.
Eigen::Vector3d centre_of(const octomap::OcTree& tree, const OctomapCell& cell);

}  // namespace ppm
