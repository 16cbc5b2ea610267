#include "apps/report/bands.hpp"

#include <algorithm>
#include <map>

#include "apps/report/statistics.hpp"
#include "framework/core/timing.hpp"

namespace ppm::report {

Band over_seeds(const std::vector<const Run*>& runs, const std::string& curve) {
  std::map<double, std::vector<double>> values;
  for (const auto* run : runs) {
    const auto found = run->curves.find(curve);
    if (found == run->curves.end()) continue;
    for (std::size_t k = 0; k < found->second.x.size(); ++k) values[found->second.x[k]].push_back(found->second.y[k]);
  }
  Band band;
  for (const auto& [x, ys] : values) {
    const auto [low, high] = std::ranges::minmax(ys);
    band.x.push_back(x);
    band.mid.push_back(median(ys));
    band.low.push_back(low);
    band.high.push_back(high);
  }
  return band;
}

Band thinned(const Band& band, std::size_t most) {
  const auto size = band.x.size();
  if (size <= most) return band;
  const bool single = band.low == band.high;
  Band thin;
  for (std::size_t k = 0; k < most; ++k) {
    const auto first = static_cast<std::ptrdiff_t>(k * size / most),
               last = static_cast<std::ptrdiff_t>((k + 1) * size / most);
    auto part = [&](const std::vector<double>& v) { return std::vector<double>(v.begin() + first, v.begin() + last); };
    thin.x.push_back(mean(part(band.x)));
    thin.mid.push_back(median(part(band.mid)));
    thin.low.push_back(single ? thin.mid.back() : std::ranges::min(part(band.low)));
    thin.high.push_back(single ? thin.mid.back() : std::ranges::max(part(band.high)));
  }
  return thin;
}

std::vector<double> running_median(const std::vector<double>& values, std::size_t window) {
  std::vector<double> smooth;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto reach = std::min({window / 2, k, values.size() - 1 - k});
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(k - reach);
    smooth.push_back(median({first, first + static_cast<std::ptrdiff_t>(2 * reach + 1)}));
  }
  return smooth;
}

}  // namespace ppm::report
