#include <cmath>
#include <fmt/core.h>
#include <set>

#include "apps/report/outputs.hpp"

namespace ppm::report {

namespace {

/// RFC 4180: in quotes where it has to be.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string text_of(const Run& run, const std::string& key) {
  const auto found = run.texts.find(key);
  return found == run.texts.end() ? "" : found->second;
}

}  // namespace

std::string runs_table(const Suite& suite) {
  std::set<std::string> keys;
  for (const auto& c : suite.comparisons)
    for (const auto& run : c.runs)
      for (const auto& [key, value] : run.numbers)
        if (key != "seed") keys.insert(key);
  std::string csv = "comparison,sequence,graph,seed,status,map_kind,digest";
  for (const auto& key : keys) csv += "," + field(key);
  csv += "\n";
  for (const auto& c : suite.comparisons) {
    for (const auto& run : c.runs) {
      csv += fmt::format("{},{},{},{},{},{},{}", field(c.name), field(run.sequence), field(run.graph), run.seed,
                         to_string(run.status), field(text_of(run, "map.kind")), text_of(run, "digest"));
      for (const auto& key : keys) {
        const auto value = run.numbers.find(key);
        csv += value == run.numbers.end() || std::isnan(value->second) ? "," : fmt::format(",{}", value->second);
      }
      csv += "\n";
    }
  }
  return csv;
}

}  // namespace ppm::report
