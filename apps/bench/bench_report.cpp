#include "apps/bench/bench_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/graph/abi.hpp"

namespace ppm {
namespace {

using Json = nlohmann::ordered_json;

/// A row for the same work by all back-ends.
struct Comparison {
  std::string work;
  std::map<std::string, double> ms;  // by back-end
};

std::vector<Comparison> compare(const std::vector<BenchResult>& results) {
  std::vector<Comparison> rows;
  for (const BenchResult& r : results) {
    if (!r.left_out.empty() || r.of->settings.empty() || r.of->settings.front().first != "backend") continue;
    BenchCase work{r.of->group, {r.of->settings.begin() + 1, r.of->settings.end()}, "", {}};
    const auto name = work.name();
    auto row = std::ranges::find(rows, name, &Comparison::work);
    if (row == rows.end()) row = rows.insert(rows.end(), {name, {}});
    row->ms[r.of->settings.front().second] = r.ms_best;
  }
  std::erase_if(rows, [](const Comparison& row) { return row.ms.size() < 2; });
  return rows;
}

/// What the others are compared with.
double reference_of(const Comparison& row) {
  const auto embree = row.ms.find("prediction.embree");
  return embree == row.ms.end() ? row.ms.begin()->second : embree->second;
}

std::string short_name(const std::string& module) {
  return module.substr(module.find('.') + 1);
}

Json case_json(const BenchResult& r) {
  Json settings = Json::object();
  for (const auto& [key, value] : r.of->settings) settings[key] = value;
  Json json = {{"name", r.of->name()}, {"group", r.of->group}, {"settings", settings}, {"item", r.of->item}};
  if (!r.left_out.empty()) {
    json["left_out"] = r.left_out;
    return json;
  }
  json["ms"] = r.ms;
  json["ms_best"] = r.ms_best;
  if (r.cpu_ms > 0) json["cpu_ms"] = r.cpu_ms;
  json["counters"] = r.counters;
  return json;
}

}  // namespace

std::string result_table(const std::vector<BenchResult>& results) {
  std::size_t width = 0;
  for (const auto& r : results) width = std::max(width, r.of->name().size());
  std::string text = fmt::format("{:<{}}  {:>10} {:>10} {:>10}\n", "", width, "ms", "best", "CPU ms");
  for (const auto& r : results) {
    text += fmt::format("{:<{}}  ", r.of->name(), width);
    if (!r.left_out.empty()) {
      text += "left out: " + r.left_out + "\n";
      continue;
    }
    text += fmt::format("{:>10.4g} {:>10.4g} {:>10} a {}", r.ms, r.ms_best,
                        r.cpu_ms > 0 ? fmt::format("{:.4g}", r.cpu_ms) : "", r.of->item);
    if (r.of->group == "roof") text += fmt::format(": {:.4g} {}/s", 1e3 / r.ms_best, r.of->item);
    for (const auto& [name, value] : r.counters) text += fmt::format(", {} {:.4g}", name, value);
    text += "\n";
  }
  return text;
}

std::string ratio_table(const std::vector<BenchResult>& results) {
  const auto rows = compare(results);
  if (rows.empty()) return "";
  std::size_t width = 0;
  std::string text = "The same work by each back-end, best ms (times as fast as embree):\n";
  for (const auto& row : rows) width = std::max(width, row.work.size());
  for (const auto& row : rows) {
    text += fmt::format("{:<{}}", row.work, width);
    for (const auto& [backend, ms] : row.ms)
      text += fmt::format("  {} {:.4g} ({:.2f}x)", short_name(backend), ms, reference_of(row) / ms);
    text += "\n";
  }
  return text;
}

std::string bench_json(const BenchSession& session, const std::vector<BenchResult>& results,
                       const std::vector<KernelShare>& kernels) {
  Json json = {{"version", PPM_VERSION},
               {"processor", session.processor},
               {"threads", session.threads},
               {"rounds", session.rounds},
               {"quick", session.quick},
               {"texel_size_m", session.texel_size_m}};
  json["cases"] = Json::array();
  for (const auto& r : results) json["cases"].push_back(case_json(r));
  json["ratios"] = Json::array();
  for (const auto& row : compare(results)) {
    Json ratio = {{"work", row.work}, {"ms", row.ms}};
    for (const auto& [backend, ms] : row.ms) ratio["times_as_fast"][backend] = reference_of(row) / ms;
    json["ratios"].push_back(ratio);
  }
  json["kernels"] = Json::array();
  for (const auto& k : kernels)
    json["kernels"].push_back({{"kernel", k.kernel},
                               {"ms", k.ms},
                               {"flops", k.flops},
                               {"bytes", k.bytes},
                               {"flops_share", k.flops_share},
                               {"read_share", k.read_share},
                               {"basis", k.basis}});
  return json.dump(2) + "\n";
}

}  // namespace ppm
