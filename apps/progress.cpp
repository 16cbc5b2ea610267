#include "apps/progress.hpp"

#include <cmath>

namespace ppm {

namespace {

constexpr double kInterval_s = 0.1;

std::string clock_text(double seconds) {
  const auto s = static_cast<std::int64_t>(std::llround(seconds));
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

void Progress::show(std::int64_t done, std::int64_t expected) {
  if (done > before_ + 1 && done != expected && since_shown_.seconds() < kInterval_s) return;
  since_shown_.reset();
  const double rate = static_cast<double>(done - before_) / since_start_.seconds();
  if (expected <= 0) {
    log_.status(fmt::format("frame {}  {:.1f} fps", done, rate));
    return;
  }
  const double left_s = static_cast<double>(expected - done) / rate;
  log_.status(fmt::format("frame {}/{}  {:.1f} fps  {} left", done, expected, rate, clock_text(left_s)));
}

}  // namespace ppm
