#include "apps/report/differences.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "framework/core/error.hpp"

namespace ppm::report {

namespace {

constexpr double kDecides = 0.9;

struct Pair {
  double subject, other;
};

/// Values of the seeds that both have tried; a run that failed has the worst value.
std::vector<Pair> pairs_of(const std::vector<const Run*>& subject, const std::vector<const Run*>& other,
                           const Measure& measure) {
  auto tried = [&](const Run& run) -> std::optional<double> {
    return run.status == RunStatus::failed ? worst(measure) : value_of(run, measure);
  };
  std::vector<Pair> pairs;
  for (const auto* a : subject) {
    const auto b = std::ranges::find(other, a->seed, &Run::seed);
    if (b == other.end()) continue;
    const auto left = tried(*a), right = tried(**b);
    if (left && right) pairs.push_back({*left, *right});
  }
  return pairs;
}

double minus(double a, double b) {
  return a == b ? 0.0 : a - b;  // two that failed are alike
}

/// Differences that the measure's digits would not show make a tie.
Verdict verdict_of(const Measure& measure, double low, double high) {
  const double shows = 0.5 * std::pow(10, -measure.digits);
  return high < -shows ? Verdict::better : low > shows ? Verdict::worse : Verdict::tie;
}

void judge(Difference& d, const std::vector<double>& losses, bool seeds_change_nothing) {
  d.interval = median_interval(losses);
  d.p = sign_test(losses);
  if (seeds_change_nothing || !d.interval) {
    d.basis = seeds_change_nothing ? Basis::exact : Basis::single;
    d.interval.reset();
    d.verdict = verdict_of(*d.measure, losses.front(), losses.front());
    return;
  }
  d.basis = d.interval->level >= kDecides ? Basis::interval : Basis::few;
  d.verdict = verdict_of(*d.measure, d.interval->low, d.interval->high);
}

double median_of(const std::vector<Pair>& pairs, double Pair::*side) {
  std::vector<double> values;
  for (const auto& pair : pairs) values.push_back(pair.*side);
  return median(values);
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::worse:
      return "worse";
    case Verdict::tie:
      return "tie";
    case Verdict::better:
      return "better";
  }
  PPM_CHECK(false, "no such verdict");
}

const char* to_string(Basis basis) {
  switch (basis) {
    case Basis::exact:
      return "exact";
    case Basis::interval:
      return "interval";
    case Basis::few:
      return "few seeds";
    case Basis::single:
      return "one run";
  }
  PPM_CHECK(false, "no such basis");
}

double Difference::severity() const {
  const double a = loss_of(*measure, subject), b = loss_of(*measure, opponent);
  if (std::isinf(a) || std::isinf(b)) return minus(a, b);
  if (std::string_view(measure->key).ends_with("log_density")) return a - b;
  const double tiny = std::numeric_limits<double>::min();
  const double ratio = std::log(std::max(std::abs(a), tiny) / std::max(std::abs(b), tiny));
  return measure->better == Better::higher ? -ratio : ratio;
}

std::optional<Difference> difference_of(const Comparison& comparison, const std::string& sequence,
                                        const std::string& other, const Measure& measure) {
  const auto ours = comparison.runs_of(sequence, comparison.subject), theirs = comparison.runs_of(sequence, other);
  if (!cell_of(ours, measure) && !cell_of(theirs, measure)) return std::nullopt;
  const auto pairs = pairs_of(ours, theirs, measure);
  if (pairs.empty()) return std::nullopt;
  Difference d;
  d.sequence = sequence;
  d.other = other;
  d.measure = &measure;
  std::vector<double> losses;
  for (const auto& pair : pairs) losses.push_back(minus(loss_of(measure, pair.subject), loss_of(measure, pair.other)));
  judge(d, losses, !measure.timing && seed_free(ours) && seed_free(theirs));
  const double sign = measure.better == Better::higher ? -1 : 1;  // losses grow where such values fall
  for (const double loss : losses) d.differences.push_back(sign * loss);
  d.median = median(d.differences);
  if (d.interval && sign < 0) d.interval = Interval{-d.interval->high, -d.interval->low, d.interval->level};
  d.subject = median_of(pairs, &Pair::subject);
  d.opponent = median_of(pairs, &Pair::other);
  return d;
}

std::vector<Difference> differences_of(const Comparison& comparison) {
  std::vector<Difference> all;
  for (const auto& sequence : comparison.sequences)
    for (const auto& graph : comparison.graphs)
      for (const auto& measure : measures())
        if (graph.name != comparison.subject && measure.telling)
          if (auto d = difference_of(comparison, sequence.name, graph.name, measure)) all.push_back(std::move(*d));
  std::ranges::stable_sort(all, {}, [](const Difference& d) {
    const int rank = 2 * static_cast<int>(d.verdict) + (d.verdict == Verdict::worse ? !d.decided() : d.decided());
    return std::tuple(rank, -d.severity());
  });
  return all;
}

std::vector<Tally> tallies_of(const Comparison& comparison, const std::vector<Difference>& differences) {
  std::vector<Tally> tallies;
  for (const auto& graph : comparison.graphs) {
    if (graph.name == comparison.subject) continue;
    Tally tally{graph.name};
    for (const auto& d : differences) {
      if (d.other != graph.name) continue;
      const bool better = d.verdict == Verdict::better, worse = d.verdict == Verdict::worse;
      (better  ? d.decided() ? tally.better : tally.leans_better
       : worse ? d.decided() ? tally.worse : tally.leans_worse
               : tally.tie) += 1;
    }
    tallies.push_back(tally);
  }
  return tallies;
}

}  // namespace ppm::report
