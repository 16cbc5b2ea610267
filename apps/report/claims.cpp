#include "apps/report/claims.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <tuple>

#include "framework/core/error.hpp"

namespace ppm::report {

namespace {

constexpr double kHalf = 0.5, kTenth = 0.1;  // what the project set out to show

Holds holds(const Reading& ratio, double limit) {
  if (ratio.value <= limit) return ratio.bound == Bound::at_least ? Holds::open : Holds::yes;
  return ratio.bound == Bound::at_most ? Holds::open : Holds::no;
}

std::string amount(const std::string& cost, double value) {
  return fmt::format("{:.3g} {}", value, cost == "memory" ? "MiB" : "ms a frame");
}

Claim error_claim(const EqualCost& e, const std::string& against) {
  const auto ratio = e.error_ratio();
  return {e.sequence, fmt::format("Held-out median at most half of that of {} at equal {}", against, e.cost),
          fmt::format("{} ({:.2f} mm, {} {:.2f} mm, at {})", shown(ratio), e.subject.error,
                      e.rival_error.bound == Bound::exact      ? "against"
                      : e.rival_error.bound == Bound::at_least ? "against at least"
                                                               : "against at most",
                      e.rival_error.value, amount(e.cost, e.subject.cost)),
          holds(ratio, kHalf), std::log(ratio.value / kHalf)};
}

Claim memory_claim(const EqualCost& e, const std::string& against) {
  const auto ratio = e.cost_ratio();
  return {e.sequence, fmt::format("Memory at most a tenth of that of {} at equal error", against),
          fmt::format("{} ({} against {}, at {:.2f} mm)", shown(ratio), amount(e.cost, e.subject.cost),
                      shown(Reading{e.rival_cost.value, e.rival_cost.bound}) + " MiB", e.subject.error),
          holds(ratio, kTenth), std::log(ratio.value / kTenth)};
}

/// Most runs of the graph failed there, or their maps miss most of what was measured.
bool fails(const Comparison& comparison, const std::string& sequence, const std::string& graph) {
  const auto runs = comparison.runs_of(sequence, graph);
  const auto outcome = outcome_of(runs);
  if (outcome.failed > outcome.done) return true;
  const auto error = cell_of(runs, measure_of(error_key(comparison)));
  return error && std::isinf(error->median);
}

/// What is claimed of maps; where a side has none to compare, that.
std::vector<Claim> map_claims(const Comparison& comparison, const std::vector<EqualCost>& equal,
                              const std::string& rival) {
  const auto name = fmt::format("the {} maps", rival);
  std::vector<Claim> claims;
  for (const auto& e : equal) {
    if (e.rival != rival) continue;
    claims.push_back(error_claim(e, name));
    if (e.cost == "memory") claims.push_back(memory_claim(e, name));
  }
  for (const auto& sequence : comparison.sequences) {
    const auto text = fmt::format("Held-out median at most half of that of {}", name);
    if (fails(comparison, sequence.name, comparison.subject))
      claims.push_back({sequence.name, text, "most runs of the subject failed, or their maps miss most pixels",
                        Holds::no, INFINITY});
    else if (fails(comparison, sequence.name, comparison.against))
      claims.push_back(
          {sequence.name, text, "most runs of the other failed, or their maps miss most pixels", Holds::open, 0});
  }
  return claims;
}

Claim path_claim(const Difference& d, const std::string& against) {
  Claim claim{d.sequence, fmt::format("ATE no worse than that of {}", against),
              fmt::format("{} cm against {} cm ({}, {})", shown(*d.measure, d.subject), shown(*d.measure, d.opponent),
                          to_string(d.verdict), to_string(d.basis)),
              Holds::yes, d.severity()};
  if (d.verdict == Verdict::worse) claim.holds = d.decided() ? Holds::no : Holds::open;
  return claim;
}

Claim most_paths_claim(const std::vector<const Difference*>& paths, const std::string& against) {
  const auto better = std::ranges::count_if(paths, [](const auto* d) { return d->verdict == Verdict::better; });
  const auto sure =
      std::ranges::count_if(paths, [](const auto* d) { return d->verdict == Verdict::better && d->decided(); });
  const auto all = static_cast<std::ptrdiff_t>(paths.size());
  const auto holds = 2 * sure > all ? Holds::yes : 2 * better > all ? Holds::open : Holds::no;
  return {"", fmt::format("ATE better than that of {} on most sequences", against),
          fmt::format("better on {} of {}, {} of them decided", better, all, sure), holds, 0.0};
}

}  // namespace

const char* to_string(Holds holds) {
  switch (holds) {
    case Holds::no:
      return "no";
    case Holds::open:
      return "open";
    case Holds::yes:
      return "yes";
  }
  PPM_CHECK(false, "no such answer");
}

std::string shown(const Reading& reading) {
  const char* bound = reading.bound == Bound::at_most    ? "at most "
                      : reading.bound == Bound::at_least ? "at least "
                                                         : "";
  return fmt::format("{}{:.3g}", bound, reading.value);
}

std::vector<Claim> claims_of(const Comparison& comparison, const std::vector<Difference>& differences,
                             const std::vector<EqualCost>& equal) {
  std::vector<Claim> claims;
  if (comparison.against.empty()) return claims;
  const auto& against = comparison.graph(comparison.against);
  const auto rival = rival_of(comparison, against.name);
  const bool same_kind =
      rival == against.family;  // a variant of the subject: memory and error are not expected to fall tenfold
  if (!same_kind) claims = map_claims(comparison, equal, rival);
  std::vector<const Difference*> paths;
  for (const auto& d : differences) {
    if (d.other != against.name || std::string_view(d.measure->key) != "trajectory.ate_rmse_m") continue;
    claims.push_back(path_claim(d, against.title));
    paths.push_back(&d);
  }
  if (!paths.empty()) claims.push_back(most_paths_claim(paths, against.title));
  std::ranges::stable_sort(claims, {}, [](const Claim& c) { return std::tuple(c.holds, -c.severity); });
  return claims;
}

}  // namespace ppm::report
