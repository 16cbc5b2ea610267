#include "apps/report/axis.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <tuple>
#include <utility>

namespace ppm::report {

namespace {

constexpr double kDecades = 6;

/// 1, 2 or 5 times a power of ten: about a fifth of the span.
double round_step(double span) {
  const double rough = span / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * 0.999) return factor * power;
  return 10 * power;
}

/// Round values, ascending, that lie within the bounds or around them: whole multiples of powers of ten where that are
/// few, else 1, 2 and 5 times, else powers of ten alone.
std::vector<double> log_marks(double low, double high) {
  std::vector<double> factors{1};
  if (high / low < 1000) factors = {1, 2, 5};
  if (high / low < 6) factors = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::vector<double> marks;
  for (double e = std::floor(std::log10(low)); e <= std::ceil(std::log10(high)); ++e)
    for (const double factor : factors) marks.push_back(factor * std::pow(10, e));
  return marks;
}

/// The marks nearest around two positive values.
std::pair<double, double> round_ends(double least, double most) {
  std::pair<double, double> ends{least, most};
  const auto marks = log_marks(least, most);
  for (const double mark : marks)
    if (mark <= least) ends.first = mark;
  for (auto mark = marks.rbegin(); mark != marks.rend() && *mark >= most; ++mark) ends.second = *mark;
  if (ends.first == ends.second) ends.second *= 2;
  return ends;
}

}  // namespace

Axis::Axis(const std::vector<double>& values, Scale scale) : log_(scale == Scale::logarithmic) {
  std::vector<double> used;
  for (const double v : values)
    if (std::isfinite(v) && (!log_ || v > 0)) used.push_back(v);
  if (used.empty()) used = {log_ ? 1.0 : 0.0, 10.0};
  const auto [least, most] = std::ranges::minmax(used);
  if (log_) {
    const double bottom = std::max(least, most / std::pow(10, kDecades));
    std::tie(low_, high_) = round_ends(bottom, most);
    return;
  }
  const double step = round_step(most > least ? most - least : std::max(std::abs(most), 1.0));
  low_ = step * std::floor(least / step);
  high_ = step * std::ceil(most / step);
  if (low_ >= high_) high_ = low_ + step;
}

double Axis::at(double value) const {
  if (log_ && value <= 0) return 0;
  const double share = log_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
  return std::clamp(share, 0.0, 1.0);
}

std::vector<double> Axis::ticks() const {
  std::vector<double> ticks;
  const double slack = 1e-9 * (high_ - low_);
  if (log_) {
    for (const double mark : log_marks(low_, high_))
      if (mark >= low_ * (1 - 1e-9) && mark <= high_ * (1 + 1e-9)) ticks.push_back(mark);
    return ticks;
  }
  const double step = round_step(high_ - low_);
  for (double k = std::ceil((low_ - slack) / step); k * step <= high_ + slack; ++k) ticks.push_back(k * step);
  return ticks;
}

std::string tick_text(double value) {
  return fmt::format("{:.6g}", value == 0 ? 0.0 : value);
}

}  // namespace ppm::report
