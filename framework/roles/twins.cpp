#include "framework/roles/twins.hpp"

#include <algorithm>
#include <compare>
#include <cstring>
#include <numeric>

namespace ppm {

namespace {

/// Any total order will do: it only brings equals together.
std::weak_ordering compare(const ParticleSet& belief, std::size_t a, std::size_t b, bool same_prediction) {
  if (auto c = std::compare_three_way()(belief.map[a].get(), belief.map[b].get()); c != 0) return c;
  if (same_prediction)
    if (auto c = std::compare_three_way()(belief.prediction[a].get(), belief.prediction[b].get()); c != 0) return c;
  return std::memcmp(belief.pose[a].data(), belief.pose[b].data(), sizeof(double) * 16) <=> 0;
}

}  // namespace

std::vector<std::size_t> twins(const ParticleSet& belief, bool same_prediction) {
  std::vector<std::size_t> order(belief.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return compare(belief, a, b, same_prediction) < 0; });
  std::vector<std::size_t> first(belief.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && compare(belief, order[k - 1], order[k], same_prediction) == 0;
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  return first;
}

}  // namespace ppm
