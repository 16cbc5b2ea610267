#include "apps/compare/planner.hpp"

#include <algorithm>

#include "framework/graph/plugin.hpp"
#include "modules/builtin.hpp"

namespace ppm {

namespace {

const std::vector<Config>& nodes_of(const Config* graph) {
  static const std::vector<Config> none;
  const Config* nodes = graph && graph->kind() == Config::Kind::map ? graph->find("nodes") : nullptr;
  return nodes ? nodes->items() : none;
}

/// What is built in, and what the plug-ins of a graph bring. Throws ConfigError for a plug-in that cannot be loaded.
Registry registry_for(const Config& graph) {
  Registry registry;
  register_builtin(registry);
  for (const auto& [library, place] : Graph::plugins(graph)) load_plugin(library, place, registry);
  return registry;
}

/// Two names that become one folder's (by other characters) are told apart by a number.
std::string graph_folder(const Comparison& comparison, const SuiteGraph& graph) {
  const std::string name = folder_name(graph.name);
  int same = 0;
  for (const auto& other : comparison.graphs) {
    if (other.name == graph.name) break;
    same += folder_name(other.name) == name;
  }
  return same == 0 ? name : fmt::format("{}~{}", name, same + 1);
}

}  // namespace

void Planner::add(Comparison& comparison) {
  leave_out(comparison);
  if (comparison.sequences.empty()) {
    for (const auto& graph : comparison.graphs) add_graph(comparison, graph, nullptr, {});
  }
  for (const auto& sequence : comparison.sequences) {
    const FrameNodes frames = frames_of(sequence);
    for (const auto& graph : comparison.graphs) {
      if (!comparison.skips(graph, sequence.name)) add_graph(comparison, graph, &sequence, frames);
    }
  }
  note_drops(comparison);
}

void Planner::leave_out(Comparison& comparison) {
  std::erase_if(comparison.graphs, [&](const SuiteGraph& graph) {
    const auto reason = graph.optional ? missing(graph) : "";
    if (!reason.empty()) plan_.left_out.push_back({comparison.name, graph.name, reason});
    return !reason.empty();
  });
  auto is_there = [&](const std::string& name) { return std::ranges::any_of(comparison.graphs, [&](const auto& g) { return g.name == name; }); };
  if (comparison.graphs.empty() || !is_there(comparison.subject)) {
    report({comparison.place, fmt::format("the subject '{}' of '{}' is left out: this ppm lacks a module of it", comparison.subject, comparison.name)});
  } else if (!is_there(comparison.against)) {
    comparison.against.clear();
    for (const auto& graph : comparison.graphs)
      if (comparison.against.empty() && graph.name != comparison.subject) comparison.against = graph.name;
  }
}

/// What this ppm lacks to run a graph, or "".
std::string Planner::missing(const SuiteGraph& graph) {
  const Config* file = load(graph.file, graph.file_place);
  if (!file) return "";
  try {
    const Registry registry = registry_for(*file);
    for (const auto& node : nodes_of(file)) {
      const Config* module = node.kind() == Config::Kind::map ? node.find("module") : nullptr;
      if (module && !registry.find(module->text())) return fmt::format("there is no module '{}'", module->text());
    }
  } catch (const ConfigError& e) {
    return e.diagnostics().front().message;
  }
  return "";
}

FrameNodes Planner::frames_of(const SuiteSequence& sequence) {
  FrameNodes frames;
  if (!sequence.like.empty()) {
    const Config* graph = load(sequence.like, sequence.like_place);
    if (graph) frames = frame_nodes(*graph);
    if (graph && frames.nodes.empty()) report({sequence.like_place, "this graph has no source of frames"});
  } else {
    frames.nodes = sequence.nodes.items();
    const Config* last = frames.nodes.empty() || frames.nodes.back().kind() != Config::Kind::map ? nullptr : frames.nodes.back().find("name");
    if (last) frames.frame = Config::scalar(last->text() + ".frame", last->place());
  }
  if (sequence.frame.kind() == Config::Kind::scalar) frames.frame = sequence.frame;
  return frames;
}

Composition Planner::composition(const Comparison& comparison, const SuiteGraph& graph, const SuiteSequence* sequence,
                                 const FrameNodes& frames) const {
  Composition how;
  how.replace = graph.replace;
  how.add = graph.add;
  how.frames = frames.nodes.empty() ? nullptr : &frames;
  for (const auto& [word, place] : comparison.runs.drop) how.drop.push_back(word);
  for (const auto& [word, place] : graph.drop) how.drop.push_back(word);
  auto append = [&](const std::vector<Override>& set) { how.set.insert(how.set.end(), set.begin(), set.end()); };
  if (sequence) append(sequence->set);
  append(graph.set);
  if (sequence && graph.set_for.contains(sequence->name)) append(graph.set_for.at(sequence->name));
  append(graph.sweep);
  return how;
}

void Planner::add_graph(const Comparison& comparison, const SuiteGraph& graph, const SuiteSequence* sequence, const FrameNodes& frames) {
  const Config* file = load(graph.file, graph.file_place);
  if (!file) return;
  const std::string sequence_name = sequence ? sequence->name : kOwnFrames;
  const auto context = fmt::format("{} on {} in {}", graph.name, sequence_name, comparison.name);
  for (const auto seed : comparison.runs.seeds) {
    Composition how = composition(comparison, graph, sequence, frames);
    for (const auto& o : sequence ? sequence->seeded : std::vector<Override>())
      how.set.push_back({o.node, o.key, Config::scalar(std::to_string(seed), o.value.place())});
    Diagnostics wrong;
    const Config experiment = compose(*file, graph.base_name + "." + sequence_name, how, wrong);
    for (auto& mistake : wrong) report(std::move(mistake), context);
    if (seed == comparison.runs.seeds.front()) check(experiment, context);
    Job job = job_of(comparison, graph, sequence_name, seed);
    const auto yaml = experiment.to_yaml();
    job.experiment = experiment_digest(job, yaml);
    plan_.jobs.push_back({std::move(job), yaml});
  }
}

void Planner::check(const Config& experiment, const std::string& context) {
  collect(context, [&] { Graph::build(experiment, registry_for(experiment)); });
}

Job Planner::job_of(const Comparison& comparison, const SuiteGraph& graph, const std::string& sequence, std::uint64_t seed) const {
  const auto& runs = comparison.runs;
  Job job;
  job.id = static_cast<int>(plan_.jobs.size());
  job.comparison = comparison.name;
  job.sequence = sequence;
  job.graph = graph.name;
  job.seed = seed;
  job.folder = std::filesystem::path("runs") / comparison.name / sequence / graph_folder(comparison, graph) / fmt::format("seed_{}", seed);
  job.threads = runs.threads;
  job.views = runs.views;
  job.memory_bytes = graph.memory_bytes > 0 ? graph.memory_bytes : runs.memory_bytes;
  job.time_limit_s = runs.time_limit_s;
  return job;
}

/// Which words leave something out: of a graph its own, of the comparison (and suite) any graph's.
void Planner::note_drops(const Comparison& comparison) {
  auto note = [&](const std::vector<std::pair<std::string, Place>>& words, const SuiteGraph& graph) {
    for (const auto& [word, place] : words) {
      Diagnostic unknown{place, fmt::format("no graph has a node or module '{}' to drop", word)};
      auto& known = drops_.try_emplace(to_string(place), std::move(unknown), false).first->second.second;
      auto fits = [&, w = word](const Config& node) { return is_node(node, w); };
      known |= std::ranges::any_of(nodes_of(load(graph.file, graph.file_place)), fits) || std::ranges::any_of(graph.replace, fits);
    }
  };
  for (const auto& graph : comparison.graphs) {
    note(graph.drop, graph);
    note(comparison.runs.drop, graph);
  }
}

void Planner::report_unknown_drops() {
  for (auto& [place, drop] : drops_)
    if (!drop.second) report(drop.first);
}

const Config* Planner::load(const std::filesystem::path& file, const Place& place) {
  auto [found, is_new] = files_.try_emplace(file);
  if (is_new && !std::filesystem::is_regular_file(file)) {
    report({place, fmt::format("no graph file '{}'", file.string())});
  } else if (is_new) {
    collect("", [&] { found->second = load_yaml(file); });
  }
  return found->second ? &*found->second : nullptr;
}

void Planner::report(Diagnostic mistake, const std::string& context) {
  if (!reported_.insert(to_string(mistake.place) + mistake.message).second) return;
  if (!context.empty()) mistake.message += " (" + context + ")";
  mistakes_.push_back(std::move(mistake));
}

}  // namespace ppm
