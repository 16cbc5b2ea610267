#include "apps/report/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm::report {

double median(std::vector<double> values) {
  PPM_CHECK(!values.empty(), "the median of nothing");
  std::ranges::sort(values);
  const auto upper = values.size() / 2;
  if (values.size() % 2 == 1 || values[upper - 1] == values[upper]) return values[upper];
  const double sum = values[upper - 1] + values[upper];
  return std::isnan(sum) ? 0.0 : sum / 2;  // -inf and inf: as much for as against
}

double binomial_tail(int k, int n) {
  double sum = 0, term = std::pow(0.5, n);
  for (int i = 0; i <= std::min(k, n); ++i) {
    sum += term;
    term *= static_cast<double>(n - i) / (i + 1);
  }
  return sum;
}

std::optional<Interval> median_interval(std::vector<double> values, double wanted) {
  const int n = static_cast<int>(values.size());
  if (n < 2) return std::nullopt;
  std::ranges::sort(values);
  auto level = [&](int k) { return 1 - 2 * binomial_tail(k - 1, n); };
  int k = 1;
  while (2 * (k + 1) <= n && level(k + 1) >= wanted) ++k;
  return Interval{values[static_cast<std::size_t>(k - 1)], values[static_cast<std::size_t>(n - k)], level(k)};
}

double sign_test(const std::vector<double>& differences) {
  const auto less = static_cast<int>(std::ranges::count_if(differences, [](double d) { return d < 0; }));
  const auto more = static_cast<int>(std::ranges::count_if(differences, [](double d) { return d > 0; }));
  return std::min(1.0, 2 * binomial_tail(std::min(less, more), less + more));
}

}  // namespace ppm::report
