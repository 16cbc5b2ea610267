#include "framework/slam/kld_sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace ppm {

double normal_quantile(double p) {
  double low = -40, high = 40;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::numbers::sqrt2) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double kld_bound(std::size_t k, double error, double z) {
  if (k <= 1) return 1;
  const double freedom = static_cast<double>(k - 1), c = 2 / (9 * freedom);
  const double root = std::max(1 - c + std::sqrt(c) * z, 0.0);
  return std::max(freedom / (2 * error) * root * root * root, 1.0);
}

std::vector<std::uint32_t> pose_bins(std::span<const Pose> poses, const Pose& origin, double bin_t, double bin_r) {
  const Pose T_origin_map = origin.inverse();
  std::map<std::array<std::int64_t, 6>, std::uint32_t> numbers;
  std::vector<std::uint32_t> bins;
  bins.reserve(poses.size());
  for (const Pose& pose : poses) {
    const Pose T = T_origin_map * pose;
    const Eigen::AngleAxisd turn(T.rotation());
    const Eigen::Vector3d r = turn.angle() * turn.axis();
    std::array<std::int64_t, 6> cell{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      cell[i] = std::llround(T.translation()[axis] / bin_t);
      cell[i + 3] = std::llround(r[axis] / bin_r);
    }
    bins.push_back(numbers.emplace(cell, static_cast<std::uint32_t>(numbers.size())).first->second);
  }
  return bins;
}

std::size_t kld_number(std::span<const double> weights, std::span<const std::uint32_t> bins, const KldLimits& limits, Rng rng) {
  std::vector<double> below(weights.size());
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) below[i] = sum += weights[i];
  std::vector<char> seen(bins.size(), 0);  // by bin: there are no more bins than particles
  std::size_t n = 0, k = 0;
  double bound = static_cast<double>(limits.least);
  while (n < limits.most && static_cast<double>(n) < bound) {
    const auto drawn = std::upper_bound(below.begin(), below.end(), rng.uniform() * sum) - below.begin();
    const auto particle = std::min(static_cast<std::size_t>(drawn), weights.size() - 1);
    ++n;
    if (std::exchange(seen[bins[particle]], 1)) continue;
    bound = std::max(bound, kld_bound(++k, limits.error, limits.z));
  }
  return n;
}

}  // namespace ppm
