#include "framework/roles/twins.hpp"

#include <algorithm>
#include <compare>
#include <cstring>
#include <numeric>

namespace ppm {

namespace {

/// By pointers and bytes: any total order will do, since it only brings equals together.
template <class Compare>
std::vector<std::size_t> lowest_equal(std::size_t count, Compare compare) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return compare(a, b) < 0; });
  std::vector<std::size_t> first(count);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && compare(order[k - 1], order[k]) == 0;
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  return first;
}

template <class Handles>
auto by_pointer(const Handles& handles, std::size_t a, std::size_t b) {
  return std::compare_three_way()(handles[a].get(), handles[b].get());
}

std::weak_ordering by_bytes(const std::vector<Pose>& poses, std::size_t a, std::size_t b) {
  return std::memcmp(poses[a].data(), poses[b].data(), sizeof(double) * 16) <=> 0;
}

}  // namespace

std::vector<std::size_t> twins(const ParticleSet& belief, bool same_prediction) {
  return lowest_equal(belief.size(), [&](std::size_t a, std::size_t b) -> std::weak_ordering {
    if (auto c = by_pointer(belief.map, a, b); c != 0) return c;
    if (same_prediction)
      if (auto c = by_pointer(belief.prediction, a, b); c != 0) return c;
    return by_bytes(belief.pose, a, b);
  });
}

std::vector<std::size_t> twins(const ParticleSet& belief, const std::vector<Pose>& poses) {
  return lowest_equal(belief.size(), [&](std::size_t a, std::size_t b) -> std::weak_ordering {
    if (auto c = by_pointer(belief.map, a, b); c != 0) return c;
    return by_bytes(poses, a, b);
  });
}

std::vector<std::size_t> map_twins(const ParticleSet& belief) {
  return lowest_equal(belief.size(), [&](std::size_t a, std::size_t b) -> std::weak_ordering {
    return by_pointer(belief.map, a, b);
  });
}

std::vector<const Map*> distinct_maps(const ParticleSet& belief) {
  const auto twin = map_twins(belief);
  std::vector<const Map*> maps;
  for (std::size_t i = 0; i < twin.size(); ++i)
    if (twin[i] == i) maps.push_back(belief.map[i].get());
  return maps;
}

}  // namespace ppm
