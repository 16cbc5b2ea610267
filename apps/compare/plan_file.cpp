#include "apps/compare/plan_file.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/compare/job_state.hpp"
#include "apps/compare/machine.hpp"
#include "framework/core/atomic_file.hpp"
#include "framework/graph/abi.hpp"

namespace ppm {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFile = "suite.json";

Json read_plan(const std::filesystem::path& folder) {
  std::ifstream in(folder / kFile);
  if (!in) throw ConfigError(Place{(folder / kFile).string()}, "cannot be read: is this the folder of a suite?");
  auto json = Json::parse(in, nullptr, false);
  if (!json.is_object()) throw ConfigError(Place{(folder / kFile).string()}, "is not the plan of a suite");
  return json;
}

Json graph_json(const SuiteGraph& graph) {
  Json json = {{"name", graph.name}, {"title", graph.title}, {"graph_file", graph.file.string()}};
  for (const auto& point : graph.sweep) {
    auto text = point.value.to_yaml();
    text.pop_back();  // the end of the line
    json["sweep"][point.node + "." + point.key] = text;
  }
  return json;
}

Json job_json(const Job& job, const std::filesystem::path& folder, const std::string& program) {
  return {{"id", job.id},
          {"sequence", job.sequence},
          {"graph", job.graph},
          {"seed", job.seed},
          {"folder", job.folder.string()},
          {"threads", job.threads},
          {"views", job.views},
          {"memory_bytes", job.memory_bytes},
          {"time_limit_s", job.time_limit_s},
          {"experiment", job.experiment},
          {"command", command_of(job, folder, program)}};
}

Json comparison_json(const Comparison& comparison, const Plan& plan, const std::filesystem::path& folder, const std::string& program) {
  Json sequences = Json::array(), graphs = Json::array(), jobs = Json::array();
  for (const auto& s : comparison.sequences) sequences.push_back({{"name", s.name}, {"title", s.title}});
  if (comparison.sequences.empty()) sequences.push_back({{"name", kOwnFrames}, {"title", "each graph's own frames"}});
  for (const auto& g : comparison.graphs) graphs.push_back(graph_json(g));
  for (const auto& planned : plan.jobs)
    if (planned.job.comparison == comparison.name) jobs.push_back(job_json(planned.job, folder, program));
  return {{"name", comparison.name},     {"title", comparison.title}, {"subject", comparison.subject},
          {"against", comparison.against}, {"sequences", sequences},    {"graphs", graphs},
          {"jobs", jobs}};
}

}  // namespace

std::string name_in_plan(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / kFile) ? read_plan(folder).value("name", "") : "";
}

std::vector<std::string> command_of(const Job& job, const std::filesystem::path& suite_folder, const std::string& program) {
  const auto folder = suite_folder / job.folder;
  std::vector<std::string> command{program,     "run",       (folder / kJobGraph).string(),
                                   "--seed",    std::to_string(job.seed), "--threads",
                                   std::to_string(job.threads), "--times"};
  if (job.views > 0) {
    command.emplace_back("--views");
    command.push_back(std::to_string(job.views));
  }
  for (const auto& word : {std::string("--quiet"), std::string("--force"), std::string("--out"), folder.string()}) command.push_back(word);
  return command;
}

void write_plan(const std::filesystem::path& folder, const Plan& plan, const std::string& program) {
  const Suite& suite = plan.suite;
  const auto machine = this_machine();
  Json json = {{"name", suite.name},
               {"title", suite.title},
               {"suite_file", suite.file.string()},
               {"suite_text", suite.text},
               {"version", PPM_VERSION},
               {"build", build_digest()},
               {"directory", std::filesystem::current_path().string()},
               {"machine", {{"cpu", machine.cpu}, {"cores", machine.cores}, {"memory_bytes", machine.memory_bytes}, {"os", machine.os}}}};
  json["comparisons"] = Json::array();
  for (const auto& c : suite.comparisons) json["comparisons"].push_back(comparison_json(c, plan, folder, program));
  json["left_out"] = Json::array();
  for (const auto& l : plan.left_out) json["left_out"].push_back({{"comparison", l.comparison}, {"graph", l.graph}, {"reason", l.reason}});
  write_file(folder / kFile, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::vector<Job> read_jobs(const std::filesystem::path& folder) {
  std::vector<Job> jobs;
  try {
    const auto plan = read_plan(folder);
    for (const auto& comparison : plan.at("comparisons")) {
      for (const auto& json : comparison.at("jobs")) {
        Job& job = jobs.emplace_back();
        job.comparison = comparison.at("name");
        json.at("id").get_to(job.id);
        json.at("sequence").get_to(job.sequence);
        json.at("graph").get_to(job.graph);
        json.at("seed").get_to(job.seed);
        job.folder = json.at("folder").get<std::string>();
        json.at("threads").get_to(job.threads);
        json.at("views").get_to(job.views);
        json.at("memory_bytes").get_to(job.memory_bytes);
        json.at("time_limit_s").get_to(job.time_limit_s);
        json.at("experiment").get_to(job.experiment);
      }
    }
  } catch (const Json::exception& e) {
    throw ConfigError(Place{(folder / kFile).string()}, fmt::format("is not the plan of a suite: {}", e.what()));
  }
  return jobs;
}

}  // namespace ppm
