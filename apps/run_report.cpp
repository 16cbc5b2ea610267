#include "apps/run_report.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "framework/core/timing.hpp"
#include "framework/graph/abi.hpp"
#include "framework/roles/weighting.hpp"
#include "framework/slam/ancestry.hpp"
#include "framework/slam/belief_digest.hpp"
#include "framework/slam/map_memory.hpp"

namespace ppm {

namespace {

using Json = nlohmann::ordered_json;

Json nodes_json(const RunReport& report) {
  Json nodes = Json::object();
  for (const auto& node : report.graph.nodes()) {
    const auto times = report.summary.nodes.find(node.name);
    if (times == report.summary.nodes.end()) continue;
    const auto& ms = times->second.ms;
    nodes[node.name] = {{"module", node.module_name},
                        {"runs", ms.size()},
                        {"ms_mean", mean(ms)},
                        {"ms_p50", quantile(ms, 0.5)},
                        {"ms_p99", quantile(ms, 0.99)}};
  }
  return nodes;
}

Json map_json(const ParticleSet& belief) {
  const auto& map = *belief.map[belief.best()];
  const auto stats = map.stats();
  const auto memory = map_memory(belief);
  return {{"kind", map.kind()},
          {"chunks", stats.chunks},
          {"vertices", stats.vertices},
          {"faces", stats.faces},
          {"texels", stats.texels},
          {"bytes", stats.bytes},
          {"bytes_owned_total", memory.together},
          {"bytes_shared_total", memory.alone - memory.together}};
}

/// The values of a metric of the (first) weighting, frame by frame; empty where nothing is weighed.
std::vector<double> weighting_metric(const RunReport& report, const char* name) {
  std::vector<double> values;
  for (const auto& node : report.graph.nodes()) {
    if (!dynamic_cast<const Weighting*>(node.module.get())) continue;
    const auto column = report.metrics.columns().find(fmt::format("{}.{}", node.name, name));
    if (column == report.metrics.columns().end()) continue;
    for (const auto& row : column->second) values.push_back(row.value);
    break;
  }
  return values;
}

/// A number that may not be one: null.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json tracking_json(const RunReport& report) {
  const auto& t = report.tracking;
  Json json = {{"judge", nullptr}};
  if (!t.judge.empty()) {
    json = {{"judge", t.judge},
            {"unexplained_frames", t.unexplained_frames},
            {"lost_frames", t.lost_frames},
            {"longest_lost", t.longest_lost},
            {"first_lost", t.first_lost ? Json(*t.first_lost) : Json(nullptr)},
            {"lost_at_end", t.lost_at_end}};
  }
  auto mean_of = [&](const char* name) { return number(mean(weighting_metric(report, name))); };
  json["ess_min"] = number(quantile(weighting_metric(report, "ess"), 0));
  json["outlier_share_mean"] = mean_of("outlier_share");
  json["outlier_share_p95"] = number(quantile(weighting_metric(report, "outlier_share"), 0.95));
  json["miss_weight_mean"] = mean_of("miss_weight");
  json["innovation_mean"] = mean_of("innovation_mean");
  json["innovation_variance"] = mean_of("innovation_variance");
  const auto degenerate = weighting_metric(report, "degenerate");
  json["degenerate_frames"] = std::ranges::count(degenerate, 1.0);
  return json;
}

Json belief_json(const ParticleSet& belief) {
  const auto poses = spread(belief);
  const auto tree = ancestry(belief.trajectory);
  return {{"spread_m", poses.translation_m},
          {"spread_deg", poses.rotation_rad * 180 / std::numbers::pi},
          {"ancestry",
           {{"nodes", tree.nodes},
            {"depth", tree.depth},
            {"branchings", tree.branchings},
            {"coalescence_frames", tree.coalescence_frames},
            {"coalescence_s", tree.coalescence_s}}}};
}

Json trajectory_json(const TrajectoryError& t) {
  return {{"pairs", t.pairs},
          {"ate_rmse_m", t.ate_m.rmse},
          {"ate_mean_m", t.ate_m.mean},
          {"ate_median_m", t.ate_m.median},
          {"ate_max_m", t.ate_m.max},
          {"rpe_trans_rmse_m", t.rpe_trans_m.rmse},
          {"rpe_trans_mean_m", t.rpe_trans_m.mean},
          {"rpe_trans_median_m", t.rpe_trans_m.median},
          {"rpe_trans_max_m", t.rpe_trans_m.max},
          {"rpe_rot_rmse_deg", t.rpe_rot_deg.rmse},
          {"rpe_rot_mean_deg", t.rpe_rot_deg.mean},
          {"rpe_rot_median_deg", t.rpe_rot_deg.median},
          {"rpe_rot_max_deg", t.rpe_rot_deg.max}};
}

Json color_json(const ColorScore& s) {
  return {{"channels", s.channels},
          {"pixels", s.pixels},
          {"rms_as_is", s.rms_as_is},
          {"rms", s.rms},
          {"median", s.median},
          {"log_density", s.log_density},
          {"outliers", s.outliers},
          {"within_1_sigma", s.within_1_sigma},
          {"within_2_sigma", s.within_2_sigma}};
}

Json holdout_json(const Holdout& h) {
  const auto& s = h.score;
  Json json = {{"poses", h.poses},
          {"frames", h.frames},
          {"pixels", s.pixels},
          {"coverage", s.coverage},
          {"median_mm", number(s.median_mm)},  // infinite where most pixels are missed
          {"within_1cm", s.within_1cm},
          {"within_2cm", s.within_2cm},
          {"within_5cm", s.within_5cm},
          {"mean_trunc20cm_mm", s.mean_trunc20cm_mm},
          {"log_density", s.log_density},
          {"outliers", s.outliers},
          {"within_1_sigma", s.within_1_sigma},
          {"within_2_sigma", s.within_2_sigma},
          {"crps_mm", s.crps_mm},
          {"calibration", {{"nominal", CalibrationCurve::nominal()}, {"measured", s.calibration}}}};
  if (h.color) json["color"] = color_json(*h.color);
  return json;
}

/// Keys begin with `name`.
void add_distances(Json& json, const std::string& name, const SurfaceDistances& d) {
  json[name + "_median_mm"] = number(d.median_mm);  // infinite or none where the map is empty
  json[name + "_mean_mm"] = number(d.mean_mm);
  json[name + "_within_1cm"] = d.within_1cm;
  json[name + "_within_2cm"] = d.within_2cm;
  json[name + "_within_5cm"] = d.within_5cm;
}

Json surface_json(const SurfaceScore& s) {
  Json json;
  add_distances(json, "accuracy", s.accuracy);
  add_distances(json, "completeness", s.completeness);
  json["precision_2cm"] = s.precision();
  json["recall_2cm"] = s.recall();
  json["f_score_2cm"] = s.f_score();
  json["samples"] = s.accuracy.points;
  json["seen_points"] = s.completeness.points;
  return json;
}

Json reprojection_json(const ReprojectionError& e, const RevisitSettings& settings) {
  return {{"gap", settings.gap},
          {"gap_is_exact", settings.form == RevisitSettings::Gap::exactly},
          {"pairs", e.pairs},
          {"pixels", e.pixels},
          {"median_mm", number(e.median_mm)},
          {"mean_mm", number(e.mean_mm)},
          {"beyond_10cm", e.beyond_10cm}};
}

void add_accuracy(Json& json, const Accuracy& accuracy) {
  if (accuracy.trajectory) json["trajectory"] = trajectory_json(*accuracy.trajectory);
  if (accuracy.trajectory_online) {
    json["trajectory_online"] = {{"estimate", to_string(accuracy.online_estimate)}};
    json["trajectory_online"].update(trajectory_json(*accuracy.trajectory_online));
  }
  if (accuracy.holdout) json["holdout"] = holdout_json(*accuracy.holdout);
  if (accuracy.holdout_estimated) json["holdout_estimated"] = holdout_json(*accuracy.holdout_estimated);
  if (accuracy.surface) json["surface"] = surface_json(*accuracy.surface);
  if (accuracy.revisits) json["revisits"] = reprojection_json(*accuracy.revisits, {});
}

}  // namespace

std::string run_json(const RunReport& report) {
  const auto& summary = report.summary;
  const auto& belief = report.belief;
  Json json = {{"version", PPM_VERSION},
               {"graph", report.graph.name()},
               {"graph_file", report.graph_file.string()},
               {"seed", report.graph.seed()},
               {"threads", report.workers.threads()},
               {"frames", summary.frames},
               {"interrupted", summary.interrupted},
               {"resumed", summary.resumed},
               {"wall_s", summary.wall_s},
               {"fps", summary.wall_s > 0 ? static_cast<double>(summary.frames) / summary.wall_s : 0.0},
               {"particles", belief.size()},
               {"ess_mean", number(mean(weighting_metric(report, "ess")))},
               {"tracking", tracking_json(report)},
               {"nodes", nodes_json(report)}};
  if (belief.size() > 0) {
    const auto best = belief.best();
    json["belief"] = belief_json(belief);
    if (belief.map[best]) json["map"] = map_json(belief);
    if (!belief.trajectory[best].empty()) json["last_index"] = belief.trajectory[best].last().frame;
  }
  add_accuracy(json, report.accuracy);
  if (const auto& c = report.checkpoints; c.frame > 0)
    json["checkpoints"] = {{"written", c.ms.size()}, {"frame", c.frame}, {"bytes", c.bytes}, {"ms_mean", mean(c.ms)}};
  json["digest"] = belief_digest(belief, report.workers);
  json["files"] = report.files;
  return json.dump(2) + "\n";
}

std::string revisits_json(const ReprojectionError& error, const RevisitSettings& settings) {
  return Json{{"revisits", reprojection_json(error, settings)}}.dump(2) + "\n";
}

std::string accuracy_json(const Accuracy& accuracy) {
  Json json = Json::object();
  add_accuracy(json, accuracy);
  return json.dump(2) + "\n";
}

std::int64_t last_index_of_run(const std::filesystem::path& run) {
  const auto file = run / "run.json";
  std::ifstream in(file);
  if (!in) throw ConfigError(Place{file.string()}, "cannot be read: is this the folder of a run?");
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object() || !json.contains("last_index") || !json["last_index"].is_number_integer())
    throw ConfigError(Place{file.string()}, "names no last frame (last_index)");
  return json["last_index"].get<std::int64_t>();
}

}  // namespace ppm
