#include "apps/report/suite_folder.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/report/read_run.hpp"
#include "framework/core/error.hpp"

namespace ppm::report {

namespace {

using Json = nlohmann::ordered_json;

std::string scalar_text(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string title_of(const Json& json) {
  const auto title = json.value("title", "");
  return title.empty() ? json.at("name").get<std::string>() : title;
}

std::vector<std::pair<std::string, std::string>> machine_of(const Json& json) {
  std::vector<std::pair<std::string, std::string>> words;
  for (const auto& [key, value] : json.items()) {
    if (key == "memory_bytes")
      words.emplace_back("memory", fmt::format("{:.0f} GiB", value.get<double>() / (1024.0 * 1024 * 1024)));
    else
      words.emplace_back(key, scalar_text(value));
  }
  return words;
}

GraphEntry graph_of(const Json& json) {
  const auto name = json.at("name").get<std::string>();
  const auto title = title_of(json);
  GraphEntry graph{name, title, name, title, {}};
  if (const auto at = name.find('[');
      at != std::string::npos) {  // of a sweep: "ppm_t[init.texel_size=1 cm]", "PPM, init.texel_size=1 cm"
    graph.family = name.substr(0, at);
    const auto point = ", " + name.substr(at + 1, name.size() - at - 2);
    if (title.ends_with(point)) graph.family_title = title.substr(0, title.size() - point.size());
  }
  if (json.contains("sweep") && json["sweep"].is_object())
    for (const auto& [key, value] : json["sweep"].items()) graph.sweep[key] = scalar_text(value);
  return graph;
}

/// A run's command for someone who stands in the suite's folder, wherever that was: the program by its name, files of
/// the run from there.
std::vector<std::string> command_there(std::vector<std::string> command, const std::string& run_folder) {
  for (auto& word : command)
    if (const auto at = word.find(run_folder); at != std::string::npos) word.erase(0, at);
  if (!command.empty()) command.front() = std::filesystem::path(command.front()).filename().string();
  return command;
}

Run run_of(const std::filesystem::path& suite, const Json& job) {
  Run run;
  run.id = scalar_text(job.at("id"));
  run.sequence = job.at("sequence");
  run.graph = job.at("graph");
  run.seed = job.at("seed");
  run.folder = job.at("folder").get<std::string>();
  run.command = command_there(job.at("command").get<std::vector<std::string>>(), run.folder.string());
  read_run(suite, run);
  return run;
}

Comparison comparison_of(const std::filesystem::path& suite, const Json& json) {
  Comparison c{json.at("name"), title_of(json), json.at("subject"), json.value("against", ""), {}, {}, {}};
  for (const auto& s : json.at("sequences")) c.sequences.push_back({s.at("name"), title_of(s)});
  for (const auto& g : json.at("graphs")) c.graphs.push_back(graph_of(g));
  for (const auto& job : json.at("jobs")) c.runs.push_back(run_of(suite, job));
  return c;
}

}  // namespace

const char* to_string(RunStatus status) {
  switch (status) {
    case RunStatus::done:
      return "done";
    case RunStatus::failed:
      return "failed";
    case RunStatus::running:
      return "running";
    case RunStatus::missing:
      return "missing";
  }
  PPM_CHECK(false, "no such status");
}

std::vector<const Run*> Comparison::runs_of(const std::string& sequence, const std::string& graph) const {
  std::vector<const Run*> found;
  for (const auto& run : runs)
    if (run.sequence == sequence && run.graph == graph) found.push_back(&run);
  std::ranges::stable_sort(found, {}, [](const Run* run) { return run->seed; });
  return found;
}

const GraphEntry& Comparison::graph(const std::string& wanted) const {
  const auto found = std::ranges::find(graphs, wanted, &GraphEntry::name);
  PPM_CHECK(found != graphs.end(), "comparison {} has no graph {}", name, wanted);
  return *found;
}

Suite read_suite(const std::filesystem::path& folder) {
  const auto file = folder / "suite.json";
  std::ifstream in(file);
  if (!in) throw ConfigError(Place{file.string()}, "cannot be read: is this the folder of a suite?");
  const auto json = Json::parse(in, nullptr, false);
  if (!json.is_object()) throw DataError(file.string(), "is no JSON");
  try {
    const std::filesystem::path suite_file = json.value("suite_file", "");
    Suite suite{folder,
                json.at("name"),
                title_of(json),
                suite_file.filename().string(),
                json.value("suite_text", ""),
                json.value("version", ""),
                {},
                {}};
    if (json.contains("machine")) suite.machine = machine_of(json["machine"]);
    for (const auto& c : json.at("comparisons")) suite.comparisons.push_back(comparison_of(folder, c));
    return suite;
  } catch (const Json::exception& e) {
    throw DataError(file.string(), e.what());
  }
}

std::string graph_text(const Suite& suite, const Run& run) {
  std::ostringstream text;
  if (std::ifstream in(suite.folder / run.folder / "graph.yaml"); in) text << in.rdbuf();
  return text.str();
}

}  // namespace ppm::report
