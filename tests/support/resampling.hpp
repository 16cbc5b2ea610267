#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/graph/harness.hpp"
#include "tests/support/registry.hpp"

namespace ppm::test {

/// The number of copies of each particle after one resampling of a belief with these weights (they need not sum to
/// one).
inline std::vector<int> copies(const std::vector<double>& weights, std::uint64_t seed,
                               const std::string& module = "resampling.systematic",
                               const std::string& params = "{ess_below: 1}") {
  Harness h(builtin(), module, params, 1, seed);
  auto& belief = h.belief();
  belief.init(weights.size(), Pose::Identity(), nullptr);
  auto& number = belief.column<std::size_t>("test/number");
  for (std::size_t i = 0; i < weights.size(); ++i) {
    number[i] = i;
    belief.log_weight[i] = std::log(weights[i]);
  }
  belief.normalize();
  h.tick();
  std::vector<int> count(weights.size());
  for (std::size_t i = 0; i < belief.size(); ++i) ++count[number[i]];
  return count;
}

}  // namespace ppm::test
