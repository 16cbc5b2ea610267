#pragma once
#include <string>
#include <vector>

#include "apps/compare/fields.hpp"
#include "apps/compare/suite.hpp"

namespace ppm {

/// Makes a Suite of a parsed file, collecting every mistake on the way.
class SuiteReader {
 public:
  Suite read(const Config& file);
  Diagnostics& mistakes() { return mistakes_; }

 private:
  // read_suite.cpp: the suite, its comparisons, what both can say of runs
  Comparison read_comparison(const Config& tree, const RunSettings& of_suite);
  void declare_runs(Params& params, RunSettings& runs) const;
  void read_runs(const Config& tree, RunSettings& runs);
  void read_seeds(const Config& seeds, RunSettings& runs);
  void read_slurm(const Config& tree, Suite& suite);
  void read_skipped(const Config& list, Comparison& comparison);
  void check_pair(const Config& tree, Comparison& comparison);

  // read_suite_graphs.cpp: sequences, graphs, sweeps
  SuiteSequence read_sequence(const Config& tree);
  void read_graph(const Config& tree, Comparison& comparison);
  std::vector<Override> read_set(const Config& tree, const std::string& key);
  Override split_key(const std::string& key, const Place& place);
  void read_nodes(const Config& tree, SuiteGraph& graph);
  bool names_node(const Config& node, const std::string& key);
  void read_set_for(const Config& tree, const Comparison& comparison, SuiteGraph& graph);
  std::vector<std::vector<Override>> read_sweep(const Config& tree);
  void check_swept(const SuiteGraph& graph, const std::vector<Override>& point);
  template <class T>
  void check_taken(const std::string& name, const Place& place, const std::string& what, const std::vector<T>& others) {
    for (const auto& other : others)
      if (other.name == name)
        report(place, fmt::format("{} name '{}' is taken, by the one at {}", what, name, to_string(other.place)));
  }

  void report(const Place& place, std::string message) { mistakes_.push_back({place, std::move(message)}); }
  Diagnostics mistakes_;
};

}  // namespace ppm
