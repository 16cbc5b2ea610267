// MRPT's resamplers as oracles for ours. Built where the package libmrpt-bayes-dev is installed.
#include <catch2/catch.hpp>
#include <map>
#include <mrpt/bayes/CParticleFilterCapable.h>
#include <mrpt/random.h>

#include "tests/support/resampling.hpp"

namespace {

using Counts = std::vector<int>;

using Mrpt = mrpt::bayes::CParticleFilter;

Counts mrpt_copies(Mrpt::TParticleResamplingAlgorithm method, const std::vector<double>& weights) {
  std::vector<double> log_weights;
  for (double w : weights) log_weights.push_back(std::log(w));
  std::vector<std::size_t> index;
  mrpt::bayes::CParticleFilterCapable::computeResampling(method, log_weights, index);
  Counts count(weights.size());
  for (auto i : index) ++count[i];
  return count;
}

}  // namespace

// Not the residual form: MRPT's gives particles other numbers of copies than n w on average (2.5 for 1.86 here).
TEST_CASE("resampling gives the same outcomes as MRPT's, equally often") {
  const auto [module, method] = GENERATE(table<std::string, Mrpt::TParticleResamplingAlgorithm>(
      {{"systematic", Mrpt::prSystematic},
       {"stratified", Mrpt::prStratified},
       {"multinomial", Mrpt::prMultinomial}}));
  CAPTURE(module);
  const std::vector<double> weights{0.05, 0.31, 0.02, 0.24, 0.11, 0.27};
  constexpr int runs = 5000;
  mrpt::random::getRandomGenerator().randomize(1);
  std::map<Counts, std::pair<int, int>> seen;  // outcome -> how often ours, how often MRPT's
  for (int s = 0; s < runs; ++s) {
    ++seen[ppm::test::copies(weights, static_cast<std::uint64_t>(s), "resampling." + module)].first;
    ++seen[mrpt_copies(method, weights)].second;
  }
  CHECK(seen.size() > 3);
  for (const auto& [outcome, n] : seen) {
    const double p = 0.5 * (n.first + n.second) / runs;
    const double standard_error = std::sqrt(2 * p * (1 - p) / runs);
    INFO("outcome with " << n.first << " of ours and " << n.second << " of MRPT's");
    CHECK(std::abs(n.first - n.second) <= 4 * standard_error * runs + 4);
  }
}
