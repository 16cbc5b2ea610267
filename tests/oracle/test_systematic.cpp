// MRPT's systematic resampler as an oracle for ours. Built where the package libmrpt-bayes-dev is installed.
#include <catch2/catch.hpp>
#include <map>
#include <mrpt/bayes/CParticleFilterCapable.h>
#include <mrpt/random.h>

#include "tests/support/resampling.hpp"

namespace {

using Counts = std::vector<int>;

Counts mrpt_copies(const std::vector<double>& weights) {
  std::vector<double> log_weights;
  for (double w : weights) log_weights.push_back(std::log(w));
  std::vector<std::size_t> index;
  mrpt::bayes::CParticleFilterCapable::computeResampling(mrpt::bayes::CParticleFilter::prSystematic, log_weights,
                                                         index);
  Counts count(weights.size());
  for (auto i : index) ++count[i];
  return count;
}

}  // namespace

TEST_CASE("systematic resampling gives the same outcomes as MRPT's, equally often") {
  const std::vector<double> weights{0.05, 0.31, 0.02, 0.24, 0.11, 0.27};
  constexpr int runs = 5000;
  mrpt::random::getRandomGenerator().randomize(1);
  std::map<Counts, std::pair<int, int>> seen;  // outcome -> how often ours, how often MRPT's
  for (int s = 0; s < runs; ++s) {
    ++seen[ppm::test::copies(weights, static_cast<std::uint64_t>(s))].first;
    ++seen[mrpt_copies(weights)].second;
  }
  CHECK(seen.size() > 3);
  for (const auto& [outcome, n] : seen) {
    const double p = 0.5 * (n.first + n.second) / runs;
    const double standard_error = std::sqrt(2 * p * (1 - p) / runs);
    INFO("outcome with " << n.first << " of ours and " << n.second << " of MRPT's");
    CHECK(std::abs(n.first - n.second) <= 4 * standard_error * runs + 4);
  }
}
