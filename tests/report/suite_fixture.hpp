#pragma once
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/temp_folder.hpp"

namespace ppm::test {

inline void put(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

inline std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// How one made-up graph does; what a run leaves follows from that and from its seed.
struct MadeUp {
  std::string name, title, kind;
  double error_mm = 10, mebibytes = 1, ate_cm = 2, cpu_ms = 5;
  double seed_noise = 0.02;  ///< share by which the third seed is better than the second, and so on
  std::string sweep_value;   ///< of init.size, or ""
};

/// The folder of a suite with made-up runs: one comparison, two sequences, seeds from 1 on.
class SuiteFixture {
 public:
  std::vector<MadeUp> graphs{{"ppm", "PPM", "ppm", 8, 2, 2, 5, 0.02, ""},
                             {"vdb_5cm", "OpenVDB <5 cm>", "vdb", 40, 4, 3, 12, 0.02, ""},
                             {"vdb_2cm", "OpenVDB 2 cm", "vdb", 20, 45, 1.5, 40, 0.02, ""},
                             {"fine[init.size=1 cm]", "PPM, init.size=1 cm", "ppm", 7.9, 4, 2, 6, 0, "1 cm"},
                             {"fine[init.size=4 cm]", "PPM, init.size=4 cm", "ppm", 8.4, 1, 2, 4, 0, "4 cm"}};
  int seeds = 5, frames = 40;
  bool reference = true;  ///< poses and held-out frames seen from them

  std::filesystem::path path() const { return folder_.path(); }
  std::filesystem::path run(const std::string& sequence, const std::string& graph, int seed) const {
    return path() / "runs" / "main" / sequence / graph / ("seed_" + std::to_string(seed));
  }

  /// Writes all of it.
  void write() const {
    nlohmann::ordered_json jobs = nlohmann::json::array(), entries = nlohmann::json::array();
    int id = 0;
    for (const auto& graph : graphs) {
      entries.push_back({{"name", graph.name}, {"title", graph.title}});
      if (!graph.sweep_value.empty()) entries.back()["sweep"] = {{"init.size", graph.sweep_value}};
      for (const char* sequence : {"kitchen", "room"}) {
        for (int seed = 1; seed <= seeds; ++seed) {
          const auto folder = run(sequence, graph.name, seed);
          write_run(folder, graph, seed);
          jobs.push_back({{"id", id++},
                          {"sequence", sequence},
                          {"graph", graph.name},
                          {"seed", seed},
                          {"folder", std::filesystem::relative(folder, path()).string()},
                          {"command",
                           {"/some/where/ppm", "run",
                            "/else/where/" + std::filesystem::relative(folder, path()).string() + "/graph.yaml",
                            "--seed", std::to_string(seed)}}});
        }
      }
    }
    const nlohmann::ordered_json suite = {
        {"name", "made_up"},
        {"title", "A suite & its <runs>"},
        {"suite_file", "/some/where/made_up.yaml"},
        {"suite_text", "name: made_up # <not> \"a\" tag\n"},
        {"version", "0.1.0"},
        {"machine", {{"cpu", "a processor"}, {"cores", 2}, {"memory_bytes", 8589934592.0}, {"os", "an os"}}},
        {"comparisons",
         {{{"name", "main"},
           {"title", "Mapping"},
           {"subject", "ppm"},
           {"against", "vdb_2cm"},
           {"sequences", {{{"name", "kitchen"}, {"title", "Kitchen"}}, {{"name", "room"}, {"title", "Room"}}}},
           {"graphs", entries},
           {"jobs", jobs}}}}};
    put(path() / "suite.json", suite.dump(1));
  }

  void write_run(const std::filesystem::path& folder, const MadeUp& graph, int seed) const {
    const double noise = 1 + graph.seed_noise * (seed - 3);
    nlohmann::ordered_json json = {{"version", "0.1.0"},
                                   {"graph", graph.name},
                                   {"seed", seed},
                                   {"frames", frames},
                                   {"fps", 1000 / graph.cpu_ms},
                                   {"tracking", {{"judge", "recover"}, {"lost_frames", 0}, {"lost_at_end", false}}},
                                   {"map", {{"kind", graph.kind}, {"bytes_owned_total", graph.mebibytes * 1048576}}},
                                   {"digest", graph.seed_noise == 0 ? "same" : "digest" + std::to_string(seed)}};
    if (reference) {
      json["trajectory"] = {{"pairs", frames},
                            {"ate_rmse_m", graph.ate_cm / 100 * noise},
                            {"ate_max_m", graph.ate_cm / 50 * noise},
                            {"rpe_trans_rmse_m", 0.004 * noise}};
      json["holdout"] = {{"poses", "reference"},
                         {"coverage", 0.99},
                         {"median_mm", graph.error_mm * noise},
                         {"mean_trunc20cm_mm", 2 * graph.error_mm * noise},
                         {"log_density", 2 - graph.error_mm / 20 * noise},
                         {"within_1_sigma", 0.7},
                         {"calibration", {{"nominal", {0.1, 0.5, 0.9}}, {"measured", {0.12, 0.55, 0.91}}}}};
    }
    put(folder / "run.json", json.dump(1));
    put(folder / "job.json",
        nlohmann::json{{"status", "done"}, {"exit_code", 0}, {"wall_s", 3.5}, {"peak_rss_bytes", 1e8}, {"seed", seed}}
            .dump());
    put(folder / "graph.yaml",
        "name: " + std::string("x\nnodes:\n  - {name: init, module: map.") + graph.kind +
            "_empty, params: {size: " + (graph.sweep_value.empty() ? "2 cm" : graph.sweep_value) + "}}\n");
    std::string ate = "frame,stamp_s,error_m,online_error_m\n", memory = "frame,weigh.ess,table.map_bytes_owned\n",
                times = "frame,wall_ms,cpu_ms,resident_mb,heap_mb\n",
                holdout = "poses,frame,pixels,coverage,median_mm,mean_trunc20cm_mm,log_density\n";
    for (int k = 0; k < frames; ++k) {
      const double grown = static_cast<double>(k + 1) / frames;
      ate += std::to_string(k) + "," + std::to_string(100 + k * 0.1) + "," +
             std::to_string(graph.ate_cm / 100 * noise * grown) + ",\n";
      memory +=
          std::to_string(k) + ",," + (k % 10 == 0 ? std::to_string(graph.mebibytes * 1048576 * grown) : "") + "\n";
      times += std::to_string(k) + ",9," + std::to_string(graph.cpu_ms * noise) + ",100,50\n";
      if (k % 10 == 5)
        holdout += "reference," + std::to_string(k) + ",100,0.99," + std::to_string(graph.error_mm * noise) + ",1,1\n";
    }
    if (reference) {
      put(folder / "trajectory_error.csv", ate);
      put(folder / "holdout.csv", holdout);
    }
    put(folder / "metrics.csv", memory);
    put(folder / "times.csv", times);
  }

  void fail(const std::string& sequence, const std::string& graph, int seed, const std::string& why) const {
    const auto folder = run(sequence, graph, seed);
    std::filesystem::remove_all(folder);
    put(folder / "job.json", nlohmann::json{{"status", "failed"}, {"exit_code", 1}, {"error", why}}.dump());
  }

 private:
  TempFolder folder_;
};

}  // namespace ppm::test
