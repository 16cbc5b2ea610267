#include "modules/maps/octomap/octomap_ray.hpp"

#include <octomap/OcTree.h>

#include <bit>
#include <cmath>
#include <limits>

namespace ppm {

OctomapLookup::OctomapLookup(const octomap::OcTree& tree) : tree_(&tree) {
  path_[0] = tree.getRoot();
}

const octomap::OcTreeNode* OctomapLookup::leaf(const OctomapCell& cell) {
  if (!path_[0]) return nullptr;
  const auto differ = static_cast<std::uint16_t>((cell[0] ^ last_[0]) | (cell[1] ^ last_[1]) | (cell[2] ^ last_[2]));
  const int shared = std::countl_zero(differ);  // depth of the smallest cube that holds this cell and the last
  if (region_ > 0 && shared >= region_) return leaf_;
  last_ = cell;
  const octomap::OcTreeKey key(cell[0], cell[1], cell[2]);
  int depth = region_ > 0 ? std::min(shared, region_ - 1) : 0;
  while (depth < kDepth) {
    const auto* node = path_[static_cast<std::size_t>(depth)];
    const auto child = octomap::computeChildIdx(key, kDepth - 1 - depth);
    if (!tree_->nodeChildExists(node, child)) {
      const bool is_leaf = !tree_->nodeHasChildren(node);
      leaf_ = is_leaf ? node : nullptr;
      region_ = is_leaf ? std::max(depth, 1) : depth + 1;
      return leaf_;
    }
    path_[static_cast<std::size_t>(++depth)] = tree_->getNodeChild(node, child);
  }
  region_ = kDepth;
  return leaf_ = path_[kDepth];
}

double OctomapLookup::log_odds(const OctomapCell& cell) {
  const auto* node = leaf(cell);
  return node ? node->getLogOdds() : 0.0;
}

namespace {

/// Cells of a run that are looked at, at most: a ray along a wall sees no end of it.
constexpr int kLongestRun = 8;

/// Steps from cell to cell along a ray: the arithmetic of OcTree::castRay.
struct CellWalk {
  CellWalk(const octomap::OcTree& tree, const octomap::point3d& origin, const octomap::point3d& direction,
           const octomap::OcTreeKey& start)
      : cell{start[0], start[1], start[2]} {
    for (unsigned i = 0; i < 3; ++i) {
      step[i] = direction(i) > 0 ? 1 : direction(i) < 0 ? -1 : 0;
      next[i] = delta[i] = std::numeric_limits<double>::max();
      if (step[i] == 0) continue;
      const double border = tree.keyToCoord(start[i]) + step[i] * tree.getResolution() * 0.5;
      next[i] = (border - static_cast<double>(origin(i))) / static_cast<double>(direction(i));
      delta[i] = tree.getResolution() / std::fabs(static_cast<double>(direction(i)));
    }
  }
  /// To the next cell; false at the border of the tree's space.
  bool advance() {
    const std::size_t i = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    constexpr auto kLast = std::numeric_limits<std::uint16_t>::max();
    if (step[i] == 0 || cell[i] == (step[i] < 0 ? 0 : kLast)) return false;
    cell[i] = static_cast<std::uint16_t>(cell[i] + step[i]);
    entered = next[i];
    next[i] += delta[i];
    return true;
  }

  OctomapCell cell;
  int step[3];
  double next[3], delta[3];  // range of the next border by axis, and from border to border
  double entered = 0;
};

}  // namespace

Eigen::Vector3d centre_of(const octomap::OcTree& tree, const OctomapCell& cell) {
  return {tree.keyToCoord(cell[0]), tree.keyToCoord(cell[1]), tree.keyToCoord(cell[2])};
}

std::optional<OctomapHit> cast_ray(const octomap::OcTree& tree, OctomapLookup& lookup, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction, double range_most_m) {
  const Eigen::Vector3f o = origin.cast<float>(), d = direction.cast<float>();
  const octomap::point3d from(o.x(), o.y(), o.z());
  const octomap::point3d along = octomap::point3d(d.x(), d.y(), d.z()).normalized();
  octomap::OcTreeKey start;
  if (!tree.coordToKeyChecked(from, start)) return std::nullopt;
  CellWalk walk(tree, from, along, start);
  const double near_end = range_most_m - 2 * tree.getResolution();  // from here on centres may lie beyond the range
  while (walk.advance()) {
    if (walk.entered > near_end && (centre_of(tree, walk.cell) - o.cast<double>()).norm() > range_most_m) break;
    const auto* node = lookup.leaf(walk.cell);
    if (!node || !tree.isNodeOccupied(node)) continue;
    OctomapHit hit{walk.cell, walk.entered, walk.entered};
    for (int run = 0; run < kLongestRun && node && tree.isNodeOccupied(node) && walk.advance(); ++run) {
      hit.leaves_m = walk.entered;
      node = lookup.leaf(walk.cell);
    }
    return hit;
  }
  return std::nullopt;
}

}  // namespace ppm
