#include "apps/compare/plan.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "apps/compare/compose.hpp"
#include "framework/core/digest.hpp"
#include "framework/graph/graph_builder.hpp"
#include "framework/graph/override.hpp"
#include "framework/graph/plugin.hpp"
#include "modules/builtin.hpp"

namespace ppm {

namespace {

/// Composes and checks, collecting every mistake once, however many compositions have it.
class Planner {
 public:
  Planner(Plan& plan, const std::vector<std::filesystem::path>& plugins) : plan_(plan), plugins_(plugins) {}

  void add(const Comparison& comparison) {
    if (comparison.sequences.empty()) {
      for (const auto& graph : comparison.graphs) add(comparison, nullptr, graph);
    }
    for (const auto& sequence : comparison.sequences) {
      const FrameNodes frames = frames_of(sequence);
      for (const auto& graph : comparison.graphs) {
        if (!comparison.skips(graph, sequence.name)) add(comparison, &sequence, graph, &frames);
      }
    }
    check_dropped(comparison);
  }
  void throw_mistakes() {
    if (!mistakes_.empty()) throw ConfigError(std::move(mistakes_));
    for (std::size_t i = 0; i < plan_.jobs.size(); ++i) plan_.jobs[i].job.id = static_cast<int>(i);
  }

 private:
  /// A graph file, read once; null after a mistake.
  const Config* load(const std::filesystem::path& file, const Place& place) {
    auto [found, is_new] = files_.try_emplace(file);
    if (is_new && !std::filesystem::is_regular_file(file)) {
      report({place, fmt::format("no graph file '{}'", file.string())});
    } else if (is_new) {
      collect("", [&] { found->second = load_yaml(file); });
    }
    return found->second ? &*found->second : nullptr;
  }

  FrameNodes frames_of(const SuiteSequence& sequence) {
    FrameNodes frames;
    if (!sequence.like.empty()) {
      const Config* graph = load(sequence.like, sequence.like_place);
      if (graph) frames = frame_nodes(*graph);
      if (graph && frames.nodes.empty()) report({sequence.like_place, "this graph has no source of frames"});
    } else {
      frames.nodes = sequence.nodes.items();
      if (!frames.nodes.empty() && frames.nodes.back().kind() == Config::Kind::map && frames.nodes.back().find("name"))
        frames.frame = Config::scalar(frames.nodes.back().find("name")->text() + ".frame", frames.nodes.back().place());
    }
    if (sequence.frame.kind() == Config::Kind::scalar) frames.frame = sequence.frame;
    return frames;
  }

  void add(const Comparison& comparison, const SuiteSequence* sequence, const SuiteGraph& graph, const FrameNodes* frames = nullptr) {
    const Config* file = load(graph.file, graph.file_place);
    if (!file) return;
    const std::string sequence_name = sequence ? sequence->name : kOwnFrames;
    Composition how;
    how.frames = frames && !frames->nodes.empty() ? frames : nullptr;
    how.changes = &graph;
    for (const auto& [word, place] : comparison.runs.drop) how.drop.push_back(word);
    for (const auto& [word, place] : graph.drop) how.drop.push_back(word);
    if (sequence) how.set = sequence->set;
    auto append = [&](const std::vector<Override>& set) { how.set.insert(how.set.end(), set.begin(), set.end()); };
    append(graph.set);
    if (const auto more = graph.set_for.find(sequence_name); more != graph.set_for.end()) append(more->second);
    append(graph.sweep);
    const auto context = fmt::format("{} on {} in {}", graph.name, sequence_name, comparison.name);
    Diagnostics mistakes;
    Config experiment = compose(*file, graph.base_name + "." + sequence_name, how, mistakes);
    add_plugins(experiment);
    const auto seeded = sequence ? sequence->seeded : std::vector<std::pair<std::string, Place>>();
    const Config first = with_seed(experiment, seeded, comparison.runs.seeds.front(), mistakes);
    for (auto& m : mistakes) report(std::move(m), context);
    collect(context, [&] { check(first); });
    add_jobs(comparison, sequence_name, graph, experiment, seeded);
  }

  void add_plugins(Config& experiment) const {
    if (plugins_.empty() || experiment.kind() != Config::Kind::map) return;
    if (!experiment.find("plugins")) experiment.set("plugins", {}, Config::sequence({}, {}));
    Config& list = *experiment.find("plugins");
    for (const auto& library : plugins_)
      list.items().push_back(Config::scalar(std::filesystem::absolute(library).lexically_normal().string(),
                                            Place{"--plugin " + library.string()}));
  }

  void check(const Config& experiment) {
    Registry registry;
    register_builtin(registry);
    for (const auto& [library, place] : Graph::plugins(experiment)) load_plugin(library, place, registry);
    Graph::build(experiment, registry);
  }

  /// The experiment with the seed in the parameters that get it too.
  static Config with_seed(Config experiment, const std::vector<std::pair<std::string, Place>>& seeded, std::uint64_t seed,
                          Diagnostics& mistakes) {
    std::vector<Override> set;
    for (const auto& [word, place] : seeded)
      if (const auto key = split_key(word)) set.push_back({key->first, key->second, Config::scalar(std::to_string(seed), place)});
    if (experiment.kind() == Config::Kind::map) apply_overrides(set, experiment, mistakes);
    return experiment;
  }

  void add_jobs(const Comparison& comparison, const std::string& sequence, const SuiteGraph& graph, const Config& experiment,
                const std::vector<std::pair<std::string, Place>>& seeded) {
    const auto& runs = comparison.runs;
    const std::filesystem::path folder = std::filesystem::path("runs") / comparison.name / sequence / graph_folder(comparison, graph);
    for (const auto seed : runs.seeds) {
      Diagnostics known;  // told for the first seed
      const std::string yaml = with_seed(experiment, seeded, seed, known).to_yaml();
      Job job{0, comparison.name, sequence, graph.name, seed, folder / fmt::format("seed_{}", seed), runs.threads, runs.views,
              graph.memory_bytes > 0 ? graph.memory_bytes : runs.memory_bytes, runs.time_limit_s, ""};
      Digest digest;
      digest.add(yaml);
      digest.add(seed);
      digest.add(job.views);
      digest.add(job.threads);
      job.experiment = digest.hex();
      plan_.jobs.push_back({std::move(job), yaml});
    }
  }

  /// Two names that become one (by other characters) are told apart by a number.
  std::string graph_folder(const Comparison& comparison, const SuiteGraph& graph) const {
    const std::string name = folder_name(graph.name);
    int same = 0;
    for (const auto& other : comparison.graphs) {
      if (&other == &graph) break;
      same += folder_name(other.name) == name;
    }
    return same == 0 ? name : fmt::format("{}~{}", name, same + 1);
  }

  /// A word that leaves out nothing anywhere is a mistake.
  void check_dropped(const Comparison& comparison) {
    std::vector<const Config*> nodes;
    auto list = [&](const SuiteGraph& graph) {
      std::vector<const Config*> of_graph;
      const Config* file = load(graph.file, graph.file_place);
      const Config* all = file && file->kind() == Config::Kind::map ? file->find("nodes") : nullptr;
      if (all)
        for (const auto& node : all->items()) of_graph.push_back(&node);
      return of_graph;
    };
    auto check_words = [&](const auto& words) {
      for (const auto& [word, place] : words) {
        const bool known = std::ranges::any_of(nodes, [&, w = word](const Config* node) { return is_node(*node, w); });
        if (known) dropped_.insert(to_string(place));
        if (!known) unknown_drops_.push_back({place, fmt::format("no graph has a node or module '{}' to drop", word)});
      }
    };
    for (const auto& graph : comparison.graphs) {
      nodes = list(graph);
      check_words(graph.drop);
    }
    nodes.clear();
    for (const auto& graph : comparison.graphs)
      for (const auto* node : list(graph)) nodes.push_back(node);
    check_words(comparison.runs.drop);
  }

 public:
  /// After the last comparison: words of the suite may fit any of them.
  void report_unknown_drops() {
    for (auto& d : unknown_drops_)
      if (!dropped_.contains(to_string(d.place))) report(std::move(d));
  }

 private:
  template <class F>
  void collect(const std::string& context, F&& step) {
    try {
      step();
    } catch (const ConfigError& e) {
      for (const auto& d : e.diagnostics()) report(d, context);
    }
  }
  void report(Diagnostic mistake, const std::string& context = "") {
    if (!reported_.insert(to_string(mistake.place) + mistake.message).second) return;
    if (!context.empty()) mistake.message += " (" + context + ")";
    mistakes_.push_back(std::move(mistake));
  }

  Plan& plan_;
  const std::vector<std::filesystem::path>& plugins_;
  std::map<std::filesystem::path, std::optional<Config>> files_;
  std::set<std::string> reported_, dropped_;
  Diagnostics unknown_drops_, mistakes_;
};

}  // namespace

std::string Job::name() const {
  return fmt::format("{}/{}", kind(), seed);
}

std::string folder_name(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || std::string("_.=,-").find(c) != std::string::npos;
    if (plain) out += c;
    if (!plain && !out.empty() && out.back() != '_') out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.substr(0, 200);
}

Plan make_plan(Suite suite, const std::vector<std::filesystem::path>& plugins) {
  Plan plan{std::move(suite), {}};
  Planner planner(plan, plugins);
  for (const auto& comparison : plan.suite.comparisons) planner.add(comparison);
  planner.report_unknown_drops();
  planner.throw_mistakes();
  return plan;
}

}  // namespace ppm
