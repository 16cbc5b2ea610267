#include "apps/tracking.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <span>

namespace ppm {

namespace {

/// A metric of a node, frame by frame; empty where it recorded none.
std::span<const Metrics::Row> metric(const Metrics& metrics, const std::string& node, const char* name) {
  const auto column = metrics.columns().find(fmt::format("{}.{}", node, name));
  if (column == metrics.columns().end()) return {};
  return column->second;
}

}  // namespace

Tracking tracking_of(const Graph& graph, const Metrics& metrics) {
  Tracking tracking;
  for (const auto& node : graph.nodes())
    if (node.module_name.starts_with("recovery.") && tracking.judge.empty()) tracking.judge = node.name;
  std::int64_t in_a_row = 0;
  for (const auto& row : metric(metrics, tracking.judge, "lost")) {
    const bool lost = row.value > 0;
    in_a_row = lost ? in_a_row + 1 : 0;
    ++tracking.frames;
    tracking.lost_frames += lost;
    tracking.longest_lost = std::max(tracking.longest_lost, in_a_row);
    if (lost && !tracking.first_lost) tracking.first_lost = row.frame;
    tracking.lost_at_end = lost;
  }
  for (const auto& row : metric(metrics, tracking.judge, "unexplained")) tracking.unexplained_frames += row.value > 0;
  return tracking;
}

std::string tracking_line(const Tracking& t) {
  if (t.judge.empty()) return "";
  if (t.lost_frames == 0) return "  tracking    never lost\n";
  return fmt::format("  LOST        {} of {} frames, the first is {}, at most {} in a row; {} at the end\n",
                     t.lost_frames, t.frames, *t.first_lost, t.longest_lost,
                     t.lost_at_end ? "STILL LOST" : "found again");
}

}  // namespace ppm
