#include "apps/report/axis.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

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

/// 1, 2 and 5 times powers of ten, ascending, that lie within the bounds or around them.
std::vector<double> log_marks(double low, double high, bool fine) {
  std::vector<double> marks;
  for (double e = std::floor(std::log10(low)); e <= std::ceil(std::log10(high)); ++e)
    for (const double factor : {1.0, 2.0, 5.0})
      if (fine || factor == 1.0) marks.push_back(factor * std::pow(10, e));
  return marks;
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
    low_ = bottom / 2, high_ = most * 2;
    for (const double mark : log_marks(low_, high_, true)) {
      if (mark <= bottom) low_ = mark;
      if (mark >= most && high_ == most * 2) high_ = mark;
    }
    if (low_ >= high_) high_ = 2 * low_;
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
    for (const double mark : log_marks(low_, high_, high_ / low_ < 1000))
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
