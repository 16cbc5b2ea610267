#include "framework/slam/tempering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ppm {

double temper_for_ess(std::span<const double> log_weight, std::span<const double> log_likelihood, double ess_target,
                      double least) {
  std::vector<double> sum(log_weight.size());
  auto ess = [&](double exponent) {
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] = log_weight[i] + exponent * log_likelihood[i];
      largest = std::max(largest, sum[i]);
    }
    double weights = 0, squares = 0;
    for (double l : sum) {
      const double w = std::exp(l - largest);
      weights += w;
      squares += w * w;
    }
    return weights * weights / squares;
  };
  if (ess(1) >= ess_target) return 1;
  if (ess(least) < ess_target) return least;
  double reaches = least, misses = 1;
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (reaches + misses);
    (ess(middle) >= ess_target ? reaches : misses) = middle;
  }
  return reaches;
}

}  // namespace ppm
