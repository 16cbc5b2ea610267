#include "framework/core/timing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ppm {

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<double>(values.size());
  const double rank = std::clamp(std::ceil(q * n), 1.0, n);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (double v : values) sum += v;
  return sum / static_cast<double>(values.size());  // 0/0 = NaN where there are none
}

}  // namespace ppm
