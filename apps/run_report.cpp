#include "apps/run_report.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/core/timing.hpp"
#include "framework/graph/abi.hpp"
#include "framework/roles/weighting.hpp"
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

/// Mean over the frames of the effective sample size as the (first) weighting left it; null where nothing is weighed.
Json ess_mean(const RunReport& report) {
  for (const auto& node : report.graph.nodes()) {
    if (!dynamic_cast<const Weighting*>(node.module.get())) continue;
    const auto column = report.metrics.columns().find(node.name + ".ess");
    if (column == report.metrics.columns().end()) continue;
    std::vector<double> values;
    for (const auto& row : column->second) values.push_back(row.value);
    return mean(values);
  }
  return nullptr;
}

Json trajectory_json(const TrajectoryError& t) {
  return {{"pairs", t.pairs},
          {"ate_rmse_m", t.ate_rmse_m},
          {"ate_max_m", t.ate_max_m},
          {"rpe_trans_rmse_m", t.rpe_trans_rmse_m},
          {"rpe_rot_rmse_deg", t.rpe_rot_rmse_deg}};
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
  // An infinite median (most pixels missed) has no number in JSON: null.
  const Json median = std::isfinite(s.median_mm) ? Json(s.median_mm) : Json(nullptr);
  Json json = {{"poses", h.poses},
          {"frames", h.frames},
          {"pixels", s.pixels},
          {"coverage", s.coverage},
          {"median_mm", median},
          {"within_1cm", s.within_1cm},
          {"within_2cm", s.within_2cm},
          {"within_5cm", s.within_5cm},
          {"mean_trunc20cm_mm", s.mean_trunc20cm_mm},
          {"log_density", s.log_density},
          {"outliers", s.outliers},
          {"within_1_sigma", s.within_1_sigma},
          {"within_2_sigma", s.within_2_sigma}};
  if (h.color) json["color"] = color_json(*h.color);
  return json;
}

void add_accuracy(Json& json, const Accuracy& accuracy) {
  if (accuracy.trajectory) json["trajectory"] = trajectory_json(*accuracy.trajectory);
  if (accuracy.holdout) json["holdout"] = holdout_json(*accuracy.holdout);
  if (accuracy.holdout_estimated) json["holdout_estimated"] = holdout_json(*accuracy.holdout_estimated);
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
               {"ess_mean", ess_mean(report)},
               {"nodes", nodes_json(report)}};
  if (belief.size() > 0) {
    const auto best = belief.best();
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
