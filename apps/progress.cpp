#include "apps/progress.hpp"

#include "apps/compare/clock_text.hpp"

namespace ppm {

namespace {

constexpr double kInterval_s = 0.1;

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
