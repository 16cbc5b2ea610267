#include "apps/report/read_run.hpp"

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/report/run_curves.hpp"
#include "framework/core/error.hpp"
#include "framework/core/timing.hpp"

namespace ppm::report {

namespace {

using Json = nlohmann::json;

Json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw DataError(file.string(), "cannot be opened");
  auto json = Json::parse(in, nullptr, false);
  if (!json.is_object() && !json.is_array()) throw DataError(file.string(), "is no JSON");
  return json;
}

/// Scalars by their path; lists are left out.
void flatten(const Json& json, const std::string& path, Run& run) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) flatten(value, path.empty() ? key : path + "." + key, run);
  } else if (json.is_boolean()) {
    run.numbers[path] = json.get<bool>() ? 1 : 0;
  } else if (json.is_number()) {
    run.numbers[path] = json.get<double>();
  } else if (json.is_null()) {
    run.numbers[path] = std::numeric_limits<double>::quiet_NaN();
  } else if (json.is_string()) {
    run.texts[path] = json.get<std::string>();
  }
}

Curve calibration_of(const std::filesystem::path& file, const Json& json) {
  Curve curve;
  try {
    curve.x = json.at("nominal").get<std::vector<double>>();
    curve.y = json.at("measured").get<std::vector<double>>();
  } catch (const Json::exception&) {
    throw DataError(file.string(), "calibration needs two lists of numbers, nominal and measured");
  }
  if (curve.x.size() != curve.y.size())
    throw DataError(file.string(), "calibration: nominal and measured differ in length");
  return curve;
}

void read_results(const std::filesystem::path& folder, Run& run) {
  const auto file = folder / "run.json";
  const auto json = read_json(file);
  flatten(json, "", run);
  for (const char* kind : {"holdout", "holdout_estimated"})
    if (json.contains(kind) && json[kind].contains("calibration"))
      run.calibration[kind] = calibration_of(file, json[kind]["calibration"]);
}

/// With known poses the path is the reference, to rounding: its errors measure nothing, nor do revisits.
void forget_given_path(Run& run) {
  const auto error = run.numbers.find("trajectory.ate_max_m");
  if (error == run.numbers.end() || error->second > 1e-6) return;
  std::erase_if(run.numbers,
                [](const auto& n) { return n.first.starts_with("trajectory") || n.first.starts_with("revisits"); });
  std::erase_if(run.curves, [](const auto& c) { return c.first.starts_with("ate"); });
}

void read_views(const std::filesystem::path& suite, Run& run) {
  const auto folder = suite / run.folder / "views";
  const auto file = folder / "views.json";
  if (!std::filesystem::exists(file)) return;
  // names of pictures are relative to the views' folder
  auto picture = [&](const Json& view, const char* key) {
    return run.folder / "views" / view.at(key).get<std::string>();
  };
  try {
    for (const auto& view : read_json(file)) {
      run.views.push_back({view.at("frame").get<std::int64_t>(), view.value("poses", ""), picture(view, "measured"),
                           picture(view, "predicted"), picture(view, "error")});
    }
  } catch (const Json::exception& e) {
    throw DataError(file.string(), fmt::format("is no list of views: {}", e.what()));
  }
}

RunStatus status_of(const std::filesystem::path& file, const std::string& text) {
  for (const auto status : {RunStatus::done, RunStatus::failed, RunStatus::running})
    if (text == to_string(status)) return status;
  throw DataError(file.string(), fmt::format("status '{}' is not done, failed or running", text));
}

}  // namespace

void read_run(const std::filesystem::path& suite, Run& run) {
  const auto folder = suite / run.folder;
  const auto file = folder / "job.json";
  if (!std::filesystem::exists(file)) return;
  const auto job = read_json(file);
  run.status = status_of(file, job.value("status", ""));
  if (run.status == RunStatus::failed) {
    const auto error = job.find("error");
    run.error = error == job.end() ? "" : error->is_string() ? error->get<std::string>() : error->dump();
  }
  if (run.status != RunStatus::done) return;
  for (const auto& [key, value] : job.items())
    if (value.is_number()) run.numbers["job." + key] = value.get<double>();
  read_results(folder, run);
  run.curves = read_curves(folder);
  if (const auto times = run.curves.find("cpu_ms"); times != run.curves.end())
    run.numbers["times.cpu_ms_mean"] = mean(times->second.y);
  forget_given_path(run);
  read_views(suite, run);
}

}  // namespace ppm::report
