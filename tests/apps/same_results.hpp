#pragma once
#include <catch2/catch.hpp>
#include <set>

#include "tests/apps/command.hpp"

namespace ppm::test {

/// metrics.csv without the columns of acceleration structures built in a frame: after a resume all are built anew.
inline std::vector<std::string> lasting_metrics(const std::filesystem::path& file) {
  std::vector<std::string> rows;
  std::vector<bool> keep;
  for (const auto& line : lines(content(file))) {
    std::istringstream fields(line);
    std::string row;
    std::size_t column = 0;
    for (std::string field; std::getline(fields, field, ','); ++column) {
      if (rows.empty()) keep.push_back(!field.ends_with(".built"));
      if (keep[column]) row += field + ",";
    }
    rows.push_back(row);
  }
  return rows;
}

/// Two runs ended with the same results, though one had been stopped.
inline void same_results(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto report_a = read_json(a / "run.json"), report_b = read_json(b / "run.json");
  for (const char* key : {"digest", "frames", "last_index", "interrupted", "particles", "ess_mean", "map", "trajectory", "holdout"}) {
    INFO(key);
    CHECK(report_a[key] == report_b[key]);
  }
  for (const auto& node : report_a["nodes"].items()) {
    INFO(node.key());
    CHECK(node.value()["runs"] == report_b["nodes"][node.key()]["runs"]);
  }
  CHECK(lasting_metrics(a / "metrics.csv") == lasting_metrics(b / "metrics.csv"));
  std::set<std::string> files_a = report_a["files"], files_b = report_b["files"];
  files_b.erase("run.checkpoint");
  CHECK(files_a == files_b);
  for (const auto& name : files_a) {
    INFO(name);
    if (name != "metrics.csv" && name != "config.effective.yaml") CHECK((content(a / name) == content(b / name)));
  }
}

}  // namespace ppm::test
