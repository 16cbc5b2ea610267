#include "apps/compare/job_state.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "framework/core/atomic_file.hpp"

namespace ppm {

namespace {

constexpr const char* kFile = "job.json";
constexpr const char* kStatus[] = {"running", "done", "failed"};

}  // namespace

std::optional<JobState> read_job_state(const std::filesystem::path& folder) {
  std::ifstream in(folder / kFile);
  if (!in) return std::nullopt;
  JobState state;
  try {
    const auto json = nlohmann::json::parse(in);
    const auto status = json.at("status").get<std::string>();
    const auto known = std::find(std::begin(kStatus), std::end(kStatus), status);
    if (known == std::end(kStatus)) return std::nullopt;
    state.status = static_cast<JobState::Status>(known - std::begin(kStatus));
    json.at("experiment").get_to(state.experiment);
    json.at("build").get_to(state.build);
    json.at("seed").get_to(state.seed);
    json.at("threads").get_to(state.threads);
    json.at("command").get_to(state.command);
    state.exit_code = json.value("exit_code", 0);
    state.wall_s = json.value("wall_s", 0.0);
    state.cpu_s = json.value("cpu_s", 0.0);
    state.peak_rss_bytes = json.value("peak_rss_bytes", 0.0);
    state.error = json.value("error", "");
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
  return state;
}

void write_job_state(const std::filesystem::path& folder, const JobState& state) {
  nlohmann::ordered_json json = {{"status", kStatus[static_cast<int>(state.status)]}};
  if (state.status != JobState::Status::running) {
    json["exit_code"] = state.exit_code;
    json["wall_s"] = state.wall_s;
    json["cpu_s"] = state.cpu_s;
    json["peak_rss_bytes"] = static_cast<std::uint64_t>(state.peak_rss_bytes);
  }
  json["seed"] = state.seed;
  json["threads"] = state.threads;
  json["command"] = state.command;
  if (!state.error.empty()) json["error"] = state.error;
  json["experiment"] = state.experiment;
  json["build"] = state.build;
  write_file(folder / kFile, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void remove_job_state(const std::filesystem::path& folder) {
  std::filesystem::remove(folder / kFile);
}

void prepare_job(const std::filesystem::path& folder, const std::string& graph_yaml) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
  remove_job_state(folder);  // first: from here on the job has not run
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != kJobGraph) fs::remove_all(entry.path());
  write_file(folder / kJobGraph, graph_yaml);
}

std::string read_experiment(const std::filesystem::path& folder, const Job& job) {
  const auto file = folder / kJobGraph;
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  if (experiment_digest(job, text.str()) != job.experiment)
    throw ConfigError(Place{file.string()}, fmt::format("is not there, or not the experiment of the plan: export {} again", job.name()));
  return text.str();
}

bool is_done(const std::optional<JobState>& state, const Job& job, const std::string& build) {
  return state && state->status == JobState::Status::done && state->experiment == job.experiment &&
         (build.empty() || state->build == build);
}

std::string last_lines(const std::filesystem::path& file, int lines) {
  std::ostringstream all;
  all << std::ifstream(file, std::ios::binary).rdbuf();
  std::string text = all.str();
  while (!text.empty() && text.back() == '\n') text.pop_back();
  auto at = text.size();
  for (; lines > 0 && at != std::string::npos; --lines) at = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return at == std::string::npos ? text : text.substr(at + 1);
}

}  // namespace ppm
