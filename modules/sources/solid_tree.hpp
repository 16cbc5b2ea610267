#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/sources/solid.hpp"

namespace ppm {

/// The solid that a ray enters first.
struct TreeHit {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  SolidHit hit;
  std::uint32_t solid = kNone;
};

/// A tree of boxes over solids, four children a node, split where a ray is expected to meet the fewest of them.
/// Source: surface area heuristic, Goldsmith & Salmon, IEEE CG&A 1987; four children tested at once, Dammertz et al.,
/// EGSR 2008.
class SolidTree {
 public:
  explicit SolidTree(const std::vector<Solid>& solids);
  /// solids: those that it was made of.
  TreeHit cast(const std::vector<Solid>& solids, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

 private:
  /// The boxes of four children, a lane each, a little larger than their content, so that rounding to float loses
  /// nothing. An unused lane has an inverted box, which no ray meets.
  struct Node {
    std::array<Eigen::Array4f, 3> low, high;  // by axis
    std::array<std::uint32_t, 4> first{};     // leaf: of order_; else of nodes_
    std::array<std::uint32_t, 4> count{};     // leaf: number of solids; else 0
  };
  struct Range {
    std::uint32_t first, count;  // of order_
  };
  struct BoxRay;
  /// Returns the new node's number. level: 1 for the root.
  std::uint32_t build(const std::vector<Eigen::AlignedBox3d>& boxes, Range range, std::size_t level);
  /// Orders a range of order_ into the two parts of least cost; returns the first and makes `range` the second.
  Range split(const std::vector<Eigen::AlignedBox3d>& boxes, Range& range);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  // of solids, leaf by leaf
};

}  // namespace ppm
