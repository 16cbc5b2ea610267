#include "apps/error_tables.hpp"

#include <fmt/core.h>
#include <map>

namespace ppm {

namespace {

struct Row {
  double stamp_s = 0;
  std::string error_m, online_error_m;  // "" where there is none
};

std::string meters(double error_m) {
  return fmt::format("{:.6f}", error_m);
}

}  // namespace

std::string trajectory_error_csv(const Accuracy& accuracy) {
  std::map<std::int64_t, Row> rows;
  auto put = [&](const std::optional<TrajectoryError>& path, std::string Row::* column) {
    if (!path) return;
    for (const auto& pose : path->poses) {
      rows[pose.frame].stamp_s = pose.stamp_s;
      rows[pose.frame].*column = meters(pose.error_m);
    }
  };
  put(accuracy.trajectory, &Row::error_m);
  put(accuracy.trajectory_online, &Row::online_error_m);
  if (rows.empty()) return "";
  std::string csv = "frame,stamp_s,error_m,online_error_m\n";
  for (const auto& [frame, row] : rows)
    csv += fmt::format("{},{:.6f},{},{}\n", frame, row.stamp_s, row.error_m, row.online_error_m);
  return csv;
}

std::string holdout_csv(const Accuracy& accuracy) {
  std::string lines;
  auto put = [&](const char* poses, const std::optional<Holdout>& holdout) {
    if (!holdout) return;
    for (const auto& [frame, s] : holdout->by_frame)
      lines += fmt::format("{},{},{},{:.6f},{:.4f},{:.4f},{:.5f}\n", poses, frame, s.pixels, s.coverage, s.median_mm,
                           s.mean_trunc20cm_mm, s.log_density);
  };
  put("reference", accuracy.holdout);
  put("estimated", accuracy.holdout_estimated);
  if (lines.empty()) return "";
  return "poses,frame,pixels,coverage,median_mm,mean_trunc20cm_mm,log_density\n" + lines;
}

}  // namespace ppm
