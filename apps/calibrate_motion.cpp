#include "apps/calibrate_motion.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "apps/graph_options.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/roles/motion_errors.hpp"
#include "framework/roles/motion_model.hpp"

namespace ppm {
namespace {

struct MotionOptions {
  GraphOptions graph;
  std::vector<std::string> models;
  std::vector<int> every{1, 2, 4, 8};
  int noise_steps = 20;
  bool json = false;
};

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kLeastSteps = 10;

/// A motion model with its parameters, as YAML.
struct Model {
  std::string name;
  Config params;
  std::string learning;  ///< as YAML, but with learnt noise; empty where the model does not learn
  Config fitted;         ///< of motion.imu: the parameters under which the path is likeliest
};

Model model_of(const std::string& name, const Module& module, int noise_steps) {
  Model out{name, module.params().effective(), "", {}};
  if (module.params().find("noise_steps")) {
    Config params = out.params;
    params.set("noise_steps", {}, Config::scalar(std::to_string(noise_steps), {}));
    out.learning = params.to_yaml();
  }
  return out;
}

/// Those that were asked for, else all that are registered; with the parameters of the graph's node where it has one.
std::vector<Model> models_of(const MotionOptions& o, const Graph& graph, const Registry& registry) {
  std::vector<Model> out;
  for (const auto* info : registry.all()) {
    const bool asked = std::ranges::find(o.models, info->name) != o.models.end();
    if (!info->name.starts_with("motion.") || (!o.models.empty() && !asked)) continue;
    const auto made = info->make();
    if (!dynamic_cast<const MotionModel*>(made.get())) continue;
    const Module* module = made.get();
    for (const auto& node : graph.nodes())
      if (node.module_name == info->name) module = node.module.get();
    out.push_back(model_of(info->name, *module, o.noise_steps));
  }
  for (const auto& name : o.models)
    if (std::ranges::none_of(out, [&](const Model& m) { return m.name == name; }))
      throw ConfigError(Place{"--model"}, fmt::format("'{}' is no motion model", name));
  return out;
}

std::vector<Frame> path_of(const FrameSource& source, const std::string& graph_file) {
  std::vector<Frame> frames;
  for (const auto index : source.selected()) {
    Frame frame = source.full_frame(index);
    if (!frame.T_world_camera_ref)
      throw DataError(graph_file, index, "the image has no reference pose to compare with");
    frame.depth = {}, frame.sigma = {}, frame.confidence = {}, frame.color = {};
    frames.push_back(std::move(frame));
  }
  return frames;
}

std::vector<MotionError> errors_over(const Registry& registry, const std::string& name, const std::string& params,
                                     const std::vector<Frame>& frames, std::size_t every) {
  std::vector<MotionError> all;
  for (std::size_t phase = 0; phase < every; ++phase) {
    const auto some = motion_errors(registry, name, params, every_nth(frames, every, phase));
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// What one model does at one rate.
struct Line {
  std::size_t every;
  MotionErrorSummary given;
  std::optional<double> learnt;  ///< consistency
  std::vector<MotionError> errors;
};

std::vector<Line> lines_of(const MotionOptions& o, const Registry& registry, const Model& model,
                           const std::vector<Frame>& frames) {
  std::vector<Line> out;
  for (const int n : o.every) {
    const auto every = static_cast<std::size_t>(n);
    if (frames.size() < every * (kLeastSteps + 3)) continue;
    Line line{every, {}, {}, errors_over(registry, model.name, model.params.to_yaml(), frames, every)};
    line.given = summary(line.errors);
    if (!model.learning.empty())
      line.learnt = summary(errors_over(registry, model.name, model.learning, frames, every)).consistency;
    out.push_back(std::move(line));
  }
  return out;
}

void print_line(const Line& line) {
  const auto& s = line.given;
  fmt::print("#   {:>5} {:>6}  {:>6.1f} {:>6.1f} {:>6.1f}  {:>6.2f} {:>6.2f} {:>6.2f}  {:>7.1f} {:>6.2f}  {:>9.2f}",
             line.every, s.steps, 1e3 * s.rms[0], 1e3 * s.rms[1], 1e3 * s.rms[2], s.rms[3] / kDegree,
             s.rms[4] / kDegree, s.rms[5] / kDegree, 1e3 * s.translation_95, s.rotation_95 / kDegree, s.consistency);
  fmt::print("{}\n", line.learnt ? fmt::format(" {:>7.2f}", *line.learnt) : std::string());
}

/// What a graph's file should say.
void print_parameters(const Model& model, const Line& line) {
  const auto& s = line.given;
  if (model.name == "motion.odometry") {
    const auto t = fit_growing_noise(line.errors, false), r = fit_growing_noise(line.errors, true);
    fmt::print("  sigma_t: {:.4g} m\n  sigma_r: {:.4g} rad\n", t.least, r.least);
    fmt::print("  t_per_m: {:.3g}\n  t_per_rad: {:.3g}\n  r_per_m: {:.3g}\n  r_per_rad: {:.3g}\n", t.per_m, t.per_rad,
               r.per_m, r.per_rad);
  } else if (model.name == "motion.imu") {
    for (const char* key : {"gyro_noise", "accel_noise"}) fmt::print("  {}: {}\n", key, model.fitted.find(key)->text());
    fmt::print("  # the reference's own errors seem to be {} m, {} rad (sigma_t and sigma_r are those of the filter's poses)\n",
               model.fitted.find("sigma_t")->text(), model.fitted.find("sigma_r")->text());
  } else {
    fmt::print("  sigma_t: {:.4g} m\n  sigma_r: {:.4g} rad\n", s.sigma_t, s.sigma_r);
  }
}

nlohmann::json to_json(const Line& line) {
  const auto& s = line.given;
  nlohmann::json out{{"every", line.every},
                     {"steps", s.steps},
                     {"rms_m", {s.rms[0], s.rms[1], s.rms[2]}},
                     {"rms_rad", {s.rms[3], s.rms[4], s.rms[5]}},
                     {"sigma_t_m", s.sigma_t},
                     {"sigma_r_rad", s.sigma_r},
                     {"translation_95_m", s.translation_95},
                     {"rotation_95_rad", s.rotation_95},
                     {"consistency", s.consistency}};
  if (line.learnt) out["consistency_learnt"] = *line.learnt;
  return out;
}

/// The sensor that a model needs and the frames do not have, or "".
std::string lacking(const std::string& name, const std::vector<Frame>& frames) {
  const auto has = [&](auto what) { return std::ranges::any_of(frames, what); };
  if (name == "motion.imu" && !has([](const Frame& f) { return !f.imu.empty(); })) return "inertial samples";
  if (name == "motion.odometry" && !has([](const Frame& f) { return f.T_odom_base.has_value(); })) return "odometry";
  return "";
}

struct Result {
  Model model;
  std::string lacks;  ///< see lacking(); then there are no lines
  std::vector<Line> lines;
};

void print_table(const MotionOptions& o, const std::vector<Frame>& frames, const std::vector<Result>& results) {
  fmt::print(
      "# {} reference poses over {:.1f} s. Errors of the pose foretold from exact poses before, axes of the camera;\n"
      "# consistency: mean squared Mahalanobis distance by 6, 1 where the noise is right: as given, learnt over {} steps.\n"
      "#   every  steps      rms x y z, mm       rms about, deg       95 %: mm    deg  consistency\n",
      frames.size(), frames.back().stamp_s - frames.front().stamp_s, o.noise_steps);
  for (const auto& r : results) {
    if (!r.lacks.empty()) {
      fmt::print("# {}: the source has no {}\n", r.model.name, r.lacks);
      continue;
    }
    fmt::print("{}:\n", r.model.name);
    for (const auto& line : r.lines) print_line(line);
    print_parameters(r.model, r.lines.front());
  }
}

void print_json(const std::vector<Result>& results) {
  nlohmann::json json;
  for (const auto& r : results)
    for (const auto& line : r.lines) json[r.model.name].push_back(to_json(line));
  fmt::print("{}\n", json.dump(2));
}

void calibrate_motion(const MotionOptions& o) {
  const Graph graph = o.graph.load();
  auto* source = graph.first<FrameSource>();
  if (!source) throw ConfigError(Place{o.graph.file.string()}, "the graph has no source of images");
  source->open_for_evaluation();
  const Registry registry = make_registry(o.graph.plugins);
  const auto models = models_of(o, graph, registry);
  const auto frames = path_of(*source, o.graph.file.string());
  std::vector<Result> results;
  for (const auto& model : models) {
    Result result{model, o.models.empty() ? lacking(model.name, frames) : "", {}};
    if (result.lacks.empty()) {
      result.lines = lines_of(o, registry, model, frames);
      if (model.name == "motion.imu")
        result.model.fitted = likeliest(registry, model.name, model.params,
                                        {"gyro_noise", "accel_noise", "sigma_t", "sigma_r"}, frames);
      if (result.lines.empty())
        throw DataError(o.graph.file.string(), fmt::format("{} reference poses are too few", frames.size()));
    }
    results.push_back(std::move(result));
  }
  if (o.json) return print_json(results);
  print_table(o, frames, results);
}

}  // namespace

void add_calibrate_motion(CLI::App& calibrate) {
  auto* command = calibrate.add_subcommand(
      "motion", "Noise of motion models: how far each misses the reference path, from exact poses before");
  auto o = std::make_shared<MotionOptions>();
  o->graph.add_to(*command);
  command->add_option("--model", o->models, "A motion model, with the parameters of the graph's node where it has one; default: all")
      ->type_name("NAME");
  command->add_option("--every", o->every, "Use each n-th image; several may be given, and the parameters are printed for the first")
      ->check(CLI::Range(1, 1000))
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--noise-steps", o->noise_steps, "Steps to learn the noise from, where a model can")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_flag("--json", o->json, "As JSON");
  command->callback([o] { calibrate_motion(*o); });
}

}  // namespace ppm
