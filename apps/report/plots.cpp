#include "apps/report/plots.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <map>

#include "apps/report/bands.hpp"
#include "apps/report/statistics.hpp"

namespace ppm::report {

namespace {

constexpr std::size_t kPoints = 240;       // of a line: about two pixels of the plot each
constexpr std::size_t kSmoothFrames = 31;  // of the CPU time

/// One line a graph: the median over its seeds of a curve, with their range. A window smooths median and range.
Plot curve_plot(const Comparison& c, const SequenceEntry& sequence, const std::string& curve, std::size_t window = 1) {
  Plot plot;
  for (std::size_t g = 0; g < c.graphs.size(); ++g) {
    auto band = over_seeds(c.runs_of(sequence.name, c.graphs[g].name), curve);
    for (auto* values : {&band.mid, &band.low, &band.high})
      if (window > 1) *values = running_median(*values, window);
    const auto thin = thinned(band, kPoints);
    if (!thin.x.empty())
      plot.series.push_back({c.graphs[g].title, static_cast<int>(g), thin.x, thin.mid, thin.low, thin.high, false});
  }
  plot.log_y = wants_log(plot.series);
  return plot;
}

Plot named(Plot plot, const std::string& title, const char* x, const char* y) {
  plot.title = title;
  plot.x_label = x;
  plot.y_label = y;
  return plot;
}

/// Kinds of poses that held-out frames of a sequence were looked at from.
std::vector<std::string> kinds_of_poses(const Comparison& c, const SequenceEntry& sequence) {
  std::map<std::string, bool> kinds;
  for (const auto& run : c.runs)
    if (run.sequence == sequence.name)
      for (const auto& [name, curve] : run.curves)
        if (name.starts_with("holdout.")) kinds[name.substr(8)] = true;
  std::vector<std::string> names;
  for (const auto& [name, seen] : kinds) names.push_back(name);
  return names;
}

/// Median over the seeds of the share that each nominal probability held.
Plot calibration_plot(const Comparison& c, const SequenceEntry& sequence, const std::string& kind) {
  Plot plot;
  plot.unit_square = true;
  for (std::size_t g = 0; g < c.graphs.size(); ++g) {
    std::map<double, std::vector<double>> measured;
    for (const auto* run : c.runs_of(sequence.name, c.graphs[g].name)) {
      const auto found = run->calibration.find(kind);
      if (found == run->calibration.end()) continue;
      for (std::size_t k = 0; k < found->second.x.size(); ++k)
        measured[found->second.x[k]].push_back(found->second.y[k]);
    }
    if (measured.empty()) continue;
    PlotSeries series{c.graphs[g].title, static_cast<int>(g), {}, {}, {}, {}, false};
    for (const auto& [nominal, shares] : measured) {
      series.x.push_back(nominal);
      series.y.push_back(median(shares));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// Each graph a dot; those of a sweep a line from point to point, in the order of the suite.
Plot cost_plot(const Comparison& c, const SequenceEntry& sequence, const std::string& cost) {
  Plot plot;
  plot.log_x = plot.log_y = true;
  std::map<std::string, std::size_t> lines;
  for (std::size_t g = 0; g < c.graphs.size(); ++g) {
    const auto& graph = c.graphs[g];
    const auto point = cost_point(c, sequence.name, graph.name, cost);
    if (!point) continue;
    const auto [line, fresh] = lines.emplace(graph.family, plot.series.size());
    if (fresh) plot.series.push_back({graph.family_title, static_cast<int>(g), {}, {}, {}, {}, true});
    plot.series[line->second].x.push_back(point->cost);
    plot.series[line->second].y.push_back(point->error);
  }
  return plot;
}

}  // namespace

std::vector<Plot> plots_of(const Comparison& c, const SequenceEntry& sequence) {
  const auto& where = sequence.title;
  const char* frame = "frame";
  std::vector<Plot> plots{
      named(curve_plot(c, sequence, "ate"), where + ": error of the path", "time, s", "error after alignment, cm")};
  for (const auto& poses : kinds_of_poses(c, sequence))
    plots.push_back(named(curve_plot(c, sequence, "holdout." + poses),
                          fmt::format("{}: held-out error, {} poses", where, poses), frame, "median error, mm"));
  for (const char* kind : {"holdout", "holdout_estimated"})
    plots.push_back(named(
        calibration_plot(c, sequence, kind),
        fmt::format("{}: calibration, {} poses", where, std::string(kind) == "holdout" ? "reference" : "estimated"),
        "nominal probability of the interval", "share of errors within it"));
  plots.push_back(named(curve_plot(c, sequence, "memory"), where + ": memory of the map", frame, "MiB, all particles"));
  plots.push_back(named(curve_plot(c, sequence, "cpu_ms", kSmoothFrames),
                        fmt::format("{}: time a frame (median of {} frames)", where, kSmoothFrames), frame,
                        "CPU time, ms"));
  plots.push_back(
      named(cost_plot(c, sequence, "memory"), where + ": error against memory", "map, MiB", "held-out median, mm"));
  plots.push_back(named(cost_plot(c, sequence, "time"), where + ": error against time", "CPU time a frame, ms",
                        "held-out median, mm"));
  std::erase_if(plots, [](const Plot& plot) { return plot.series.empty(); });
  return plots;
}

}  // namespace ppm::report
