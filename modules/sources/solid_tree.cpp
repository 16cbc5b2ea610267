#include "modules/sources/solid_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

constexpr std::uint32_t kLeafSize = 2;
constexpr std::size_t kStackSize = 256;
constexpr float kPadding_m = 1e-4f, kHuge = 1e18f;

double half_area(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d s = box.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

}  // namespace

/// A ray as the boxes see it.
struct SolidTree::BoxRay {
  BoxRay(const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
    for (int k = 0; k < 3; ++k) {
      origin[k] = static_cast<float>(o[k]);
      inverse[k] = std::clamp(static_cast<float>(1 / d[k]), -kHuge, kHuge);  // no NaN from 0 * infinity
    }
  }
  /// For each child the range at which the ray enters its box; more than `limit` where it does not.
  Eigen::Array4f enter(const Node& node, float limit) const {
    Eigen::Array4f from = Eigen::Array4f::Zero(), to = Eigen::Array4f::Constant(limit);
    for (std::size_t k = 0; k < 3; ++k) {
      const bool positive = inverse[k] >= 0;
      from = from.max(((positive ? node.low[k] : node.high[k]) - origin[k]) * inverse[k]);
      to = to.min(((positive ? node.high[k] : node.low[k]) - origin[k]) * inverse[k]);
    }
    return (from <= to).select(from, Eigen::Array4f::Constant(std::numeric_limits<float>::infinity()));
  }
  std::array<float, 3> origin, inverse;
};

SolidTree::SolidTree(const std::vector<Solid>& solids) : order_(solids.size()) {
  PPM_CHECK(!solids.empty(), "a scene without solids");
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Solid& solid : solids) boxes.push_back(bounds(solid));
  build(boxes, {0, static_cast<std::uint32_t>(solids.size())}, 1);
}

std::uint32_t SolidTree::build(const std::vector<Eigen::AlignedBox3d>& boxes, Range range, std::size_t level) {
  PPM_CHECK(3 * level < kStackSize, "a tree of {} levels", level);  // cast() leaves three children a level behind
  std::vector<Range> children{range};
  for (int round = 0; round < 2; ++round)
    for (std::size_t i = children.size(); i-- > 0;)
      if (children[i].count > kLeafSize) children.push_back(split(boxes, children[i]));

  const auto number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  for (int k = 0; k < 3; ++k) {
    nodes_[number].low[k].setConstant(kHuge);
    nodes_[number].high[k].setConstant(-kHuge);
  }
  for (std::size_t c = 0; c < children.size(); ++c) {
    Eigen::AlignedBox3d box;
    for (std::uint32_t i = 0; i < children[c].count; ++i) box.extend(boxes[order_[children[c].first + i]]);
    for (int k = 0; k < 3; ++k) {
      nodes_[number].low[k][c] = static_cast<float>(box.min()[k]) - kPadding_m;
      nodes_[number].high[k][c] = static_cast<float>(box.max()[k]) + kPadding_m;
    }
    const bool leaf = children[c].count <= kLeafSize;
    const std::uint32_t first = leaf ? children[c].first : build(boxes, children[c], level + 1);  // nodes_ may move
    nodes_[number].first[c] = first;
    nodes_[number].count[c] = leaf ? children[c].count : 0;
  }
  return number;
}

SolidTree::Range SolidTree::split(const std::vector<Eigen::AlignedBox3d>& boxes, Range& range) {
  const auto begin = order_.begin() + range.first;
  std::vector<std::uint32_t> best_order;
  std::uint32_t best_count = 0;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::uint32_t> sorted(begin, begin + range.count);
    std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(boxes[a].center()[axis], a) < std::pair(boxes[b].center()[axis], b);
    });
    std::vector<double> right_area(range.count);
    Eigen::AlignedBox3d box;
    for (std::uint32_t i = range.count; i-- > 0;) right_area[i] = half_area(box.extend(boxes[sorted[i]]));
    box.setEmpty();
    for (std::uint32_t i = 1; i < range.count; ++i) {
      const double cost = i * half_area(box.extend(boxes[sorted[i - 1]])) + (range.count - i) * right_area[i];
      if (cost < best_cost) best_cost = cost, best_count = i, best_order = sorted;
    }
  }
  std::copy(best_order.begin(), best_order.end(), begin);
  const Range left{range.first, best_count};
  range = {range.first + best_count, range.count - best_count};
  return left;
}

TreeHit SolidTree::cast(const std::vector<Solid>& solids, const Eigen::Vector3d& origin,
                        const Eigen::Vector3d& direction) const {
  struct Visit {
    float range_m;
    std::uint32_t first, count;
  };
  TreeHit best;
  const BoxRay ray(origin, direction);
  std::array<Visit, kStackSize> stack;
  std::size_t depth = 0;
  float limit = kHuge;
  stack[depth++] = {0, 0, 0};
  while (depth > 0) {
    const Visit visit = stack[--depth];
    if (visit.range_m > limit) continue;
    for (std::uint32_t i = visit.first; i < visit.first + visit.count; ++i) {
      const SolidHit hit = enter(solids[order_[i]], origin, direction);
      const bool tie = best.solid != TreeHit::kNone && hit.range_m == best.hit.range_m && order_[i] < best.solid;
      if (hit.range_m < best.hit.range_m || tie) {
        best = {hit, order_[i]};
        limit = static_cast<float>(hit.range_m) + kPadding_m;
      }
    }
    if (visit.count > 0) continue;
    const Node& node = nodes_[visit.first];
    const Eigen::Array4f from = ray.enter(node, limit);
    const std::size_t base = depth;
    for (std::size_t c = 0; c < 4; ++c) {
      if (from[c] > limit) continue;
      std::size_t at = depth++;  // the nearest child on top
      for (; at > base && stack[at - 1].range_m < from[c]; --at) stack[at] = stack[at - 1];
      stack[at] = {from[c], node.first[c], node.count[c]};
    }
  }
  return best;
}

}  // namespace ppm
