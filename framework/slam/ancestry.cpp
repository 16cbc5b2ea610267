#include "framework/slam/ancestry.hpp"

#include <algorithm>

namespace ppm {

namespace {

/// Distinct paths on the way back: those that still have the greatest length, and those that join later.
class Frontier {
 public:
  explicit Frontier(std::vector<Trajectory> paths) : paths_(std::move(paths)) { make_distinct(paths_); }

  std::size_t size() const { return paths_.size(); }
  const Trajectory& any() const { return paths_.front(); }

  struct Step {
    std::size_t left = 0;        // poses that were given up
    std::size_t branchings = 0;  // poses that more than one of them went on from
    double stamp_s = 0;
  };
  /// The paths of that length, the greatest, lose their last pose; what is then empty goes.
  Step back(std::size_t length) {
    const auto longest = std::ranges::partition(paths_, [&](const auto& p) { return p.length() < length; });
    std::vector<Trajectory> parents;
    for (const auto& path : longest)
      if (length > 1) parents.push_back(path.parent());
    Step step{longest.size(), 0, longest.front().last().stamp_s};
    std::ranges::sort(parents, {}, &Trajectory::identity);
    for (std::size_t i = 1; i < parents.size(); ++i)
      step.branchings += parents[i] == parents[i - 1] && (i == 1 || !(parents[i - 1] == parents[i - 2]));
    paths_.erase(longest.begin(), longest.end());
    paths_.insert(paths_.end(), parents.begin(), parents.end());
    make_distinct(paths_);
    return step;
  }

 private:
  static void make_distinct(std::vector<Trajectory>& paths) {
    std::ranges::sort(paths, {}, &Trajectory::identity);
    const auto repeated = std::ranges::unique(paths);
    paths.erase(repeated.begin(), repeated.end());
  }
  std::vector<Trajectory> paths_;
};

}  // namespace

Ancestry ancestry(const std::vector<Trajectory>& paths) {
  std::vector<Trajectory> begun;
  std::ranges::copy_if(paths, std::back_inserter(begun), [](const auto& p) { return !p.empty(); });
  Ancestry tree;
  if (begun.empty()) return tree;
  const auto longest = std::ranges::max(begun, {}, &Trajectory::length);
  tree.depth = longest.length();
  double oldest_s = longest.last().stamp_s;
  Frontier frontier(std::move(begun));
  std::size_t length = tree.depth;
  for (; frontier.size() > 1; --length) {
    const auto step = frontier.back(length);
    tree.nodes += step.left;
    tree.branchings += step.branchings;
    oldest_s = step.stamp_s;
  }
  if (frontier.size() == 1) {
    length = frontier.any().length();
    oldest_s = frontier.any().last().stamp_s;
  }
  tree.nodes += length;
  tree.coalescence_frames = tree.depth - length;
  tree.coalescence_s = longest.last().stamp_s - oldest_s;
  return tree;
}

}  // namespace ppm
