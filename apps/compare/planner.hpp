#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/compare/compose.hpp"
#include "apps/compare/plan.hpp"

namespace ppm {

/// Makes the jobs of a plan, collecting every mistake on the way.
class Planner {
 public:
  explicit Planner(Plan& plan) : plan_(plan) {}
  void add(Comparison& comparison);
  /// After the last comparison: words to drop that fit no graph.
  void report_unknown_drops();
  Diagnostics& mistakes() { return mistakes_; }

 private:
  void leave_out(Comparison& comparison);
  std::string missing(const SuiteGraph& graph);
  FrameNodes frames_of(const SuiteSequence& sequence);
  void add_graph(const Comparison& comparison, const SuiteGraph& graph, const SuiteSequence* sequence, const FrameNodes& frames);
  Composition composition(const Comparison& comparison, const SuiteGraph& graph, const SuiteSequence* sequence, const FrameNodes& frames) const;
  void check(const Config& experiment, const std::string& context);
  Job job_of(const Comparison& comparison, const SuiteGraph& graph, const std::string& sequence, std::uint64_t seed) const;
  void note_drops(const Comparison& comparison);

  /// A graph file, read once; null after a mistake.
  const Config* load(const std::filesystem::path& file, const Place& place);
  template <class F>
  void collect(const std::string& context, F&& step) {
    try {
      step();
    } catch (const ConfigError& e) {
      for (const auto& d : e.diagnostics()) report(d, context);
    }
  }
  /// Each mistake once, with the composition where it was seen first.
  void report(Diagnostic mistake, const std::string& context = "");

  Plan& plan_;
  std::map<std::filesystem::path, std::optional<Config>> files_;
  std::set<std::string> reported_;
  std::map<std::string, std::pair<Diagnostic, bool>> drops_;  ///< by place: what is wrong where no graph has it; and whether one has
  Diagnostics mistakes_;
};

}  // namespace ppm
