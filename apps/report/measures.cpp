#include "apps/report/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/core/error.hpp"

namespace ppm::report {

namespace {

constexpr double kMiB = 1.0 / (1024.0 * 1024.0);
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr auto lower = Better::lower, higher = Better::higher, nearer = Better::nearer;

constexpr std::array kMeasures{
    // key, title, unit, scale, digits, better, target, telling, timing
    Measure{"holdout.median_mm", "held-out median", "mm", 1, 2, lower, 0, true, false},
    Measure{"holdout.mean_trunc20cm_mm", "truncated mean", "mm", 1, 1, lower, 0, true, false},
    Measure{"holdout.coverage", "coverage", "", 1, 4, higher, 0, true, false},
    Measure{"holdout.within_1cm", "within 1 cm", "", 1, 3, higher, 0, false, false},
    Measure{"holdout.within_2cm", "within 2 cm", "", 1, 3, higher, 0, false, false},
    Measure{"holdout.within_5cm", "within 5 cm", "", 1, 3, higher, 0, false, false},
    Measure{"holdout.log_density", "log density", "", 1, 3, higher, 0, true, false},
    Measure{"holdout.crps_mm", "CRPS", "mm", 1, 2, lower, 0, true, false},
    Measure{"holdout.within_1_sigma", "within 1 sigma", "", 1, 3, nearer, 0.683, false, false},
    Measure{"holdout.within_2_sigma", "within 2 sigma", "", 1, 3, nearer, 0.954, false, false},
    Measure{"holdout_estimated.median_mm", "held-out median, own poses", "mm", 1, 2, lower, 0, true, false},
    Measure{"holdout_estimated.mean_trunc20cm_mm", "truncated mean, own poses", "mm", 1, 1, lower, 0, true, false},
    Measure{"holdout_estimated.coverage", "coverage, own poses", "", 1, 4, higher, 0, true, false},
    Measure{"holdout_estimated.within_1cm", "within 1 cm, own poses", "", 1, 3, higher, 0, false, false},
    Measure{"holdout_estimated.within_2cm", "within 2 cm, own poses", "", 1, 3, higher, 0, false, false},
    Measure{"holdout_estimated.within_5cm", "within 5 cm, own poses", "", 1, 3, higher, 0, false, false},
    Measure{"holdout_estimated.log_density", "log density, own poses", "", 1, 3, higher, 0, true, false},
    Measure{"holdout_estimated.crps_mm", "CRPS, own poses", "mm", 1, 2, lower, 0, true, false},
    Measure{"holdout_estimated.within_1_sigma", "within 1 sigma, own poses", "", 1, 3, nearer, 0.683, false, false},
    Measure{"holdout_estimated.within_2_sigma", "within 2 sigma, own poses", "", 1, 3, nearer, 0.954, false, false},
    Measure{"trajectory.ate_rmse_m", "ATE", "cm", 100, 2, lower, 0, true, false},
    Measure{"trajectory.rpe_trans_rmse_m", "RPE", "mm", 1000, 2, lower, 0, true, false},
    Measure{"trajectory.rpe_rot_rmse_deg", "RPE, rotation", "deg", 1, 3, lower, 0, true, false},
    Measure{"trajectory_online.ate_rmse_m", "ATE, online", "cm", 100, 2, lower, 0, false, false},
    Measure{"revisits.median_mm", "revisits", "mm", 1, 2, lower, 0, true, false},
    Measure{"revisits.beyond_10cm", "revisits beyond 10 cm", "", 1, 4, lower, 0, false, false},
    Measure{"tracking.lost_frames", "lost frames", "", 1, 0, lower, 0, true, false},
    Measure{"surface.accuracy_median_mm", "surface accuracy", "mm", 1, 2, lower, 0, true, false},
    Measure{"surface.completeness_median_mm", "surface completeness", "mm", 1, 2, lower, 0, true, false},
    Measure{"surface.f_score_2cm", "F-score at 2 cm", "", 1, 3, higher, 0, true, false},
    Measure{"map.bytes_owned_total", "map", "MiB", kMiB, 2, lower, 0, true, false},
    Measure{"job.peak_rss_bytes", "peak memory", "MiB", kMiB, 0, lower, 0, false, true},
    Measure{"times.cpu_ms_mean", "CPU time a frame", "ms", 1, 2, lower, 0, true, true},
    Measure{"fps", "frames a second", "", 1, 1, higher, 0, false, true},
};

}  // namespace

std::span<const Measure> measures() {
  return kMeasures;
}

const Measure& measure_of(std::string_view key) {
  const auto found = std::ranges::find(kMeasures, key, [](const Measure& m) { return std::string_view(m.key); });
  PPM_CHECK(found != kMeasures.end(), "no measure {}", key);
  return *found;
}

std::optional<double> value_of(const Run& run, const Measure& measure) {
  const auto found = run.numbers.find(measure.key);
  if (run.status != RunStatus::done || found == run.numbers.end()) return std::nullopt;
  if (!std::isnan(found->second)) return measure.scale * found->second;
  const std::string_view key = measure.key;
  if (key.starts_with("holdout") && key.ends_with("median_mm")) return kInfinity;
  return std::nullopt;
}

double loss_of(const Measure& measure, double value) {
  switch (measure.better) {
    case Better::lower:
      return value;
    case Better::higher:
      return -value;
    case Better::nearer:
      return std::abs(value - measure.target);
  }
  return value;
}

double worst(const Measure& measure) {
  return measure.better == Better::higher ? -kInfinity : kInfinity;
}

std::string shown(const Measure& measure, double value) {
  return std::isinf(value) ? "failed" : fmt::format("{:.{}f}", value, measure.digits);
}

std::string heading(const Measure& measure) {
  return *measure.unit ? fmt::format("{}, {}", measure.title, measure.unit) : measure.title;
}

}  // namespace ppm::report
