#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <tuple>

#include "apps/compare/suite_reader.hpp"
#include "framework/graph/graph_builder.hpp"

namespace ppm {

namespace {

constexpr int kMostSeeds = 10'000;

/// The place of a key's value, or of the map that lacks it.
Place place_of(const Config& tree, const std::string& key) {
  const Config* value = tree.find(key);
  return value ? value->place() : tree.place();
}

std::vector<std::string> names_of(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const auto& g : comparison.graphs) names.push_back(g.name);
  return names;
}

std::string none_such(const std::string& what, const std::string& name, const std::vector<std::string>& known) {
  auto hint = suggestion(name, known);
  if (hint.empty()) hint = fmt::format("; there are: {}", fmt::join(known, ", "));
  return fmt::format("no {} '{}'{}", what, name, hint);
}

}  // namespace

bool Comparison::skips(const SuiteGraph& graph, const std::string& sequence) const {
  return std::ranges::any_of(skipped, [&](const auto& pair) {
    return (pair.first == graph.name || pair.first == graph.base_name) && pair.second == sequence;
  });
}

Suite SuiteReader::read(const Config& file) {
  Suite suite;
  if (!is_map(file, "a suite", "{name: x, comparisons: [...]}", mistakes_)) return suite;
  RunSettings runs;
  Params params;
  params.add("name", suite.name).required();
  params.add("title", suite.title);
  declare_runs(params, runs);
  read_fields(file, "the suite", params, {"seeds", "drop", "slurm", "comparisons"}, mistakes_);
  if (!suite.name.empty()) check_name(suite.name, place_of(file, "name"), "suite name", mistakes_);
  if (suite.title.empty()) suite.title = suite.name;
  read_runs(file, runs);
  if (const auto* slurm = file.find("slurm")) read_slurm(*slurm, suite);
  const auto* comparisons = field(file, "comparisons", Config::Kind::sequence, mistakes_);
  if (!file.find("comparisons")) report(file.place(), "the suite needs the key 'comparisons'");
  if (!comparisons) return suite;
  if (comparisons->items().empty()) report(comparisons->place(), "the suite has no comparisons");
  for (const auto& tree : comparisons->items()) {
    if (!is_map(tree, "a comparison", "{name: x, graphs: [...]}", mistakes_)) continue;
    auto comparison = read_comparison(tree, runs);
    check_taken(comparison.name, comparison.place, "comparison", suite.comparisons);
    suite.comparisons.push_back(std::move(comparison));
  }
  return suite;
}

Comparison SuiteReader::read_comparison(const Config& tree, const RunSettings& of_suite) {
  Comparison comparison;
  comparison.place = tree.place();
  comparison.runs = of_suite;
  Params params;
  params.add("name", comparison.name).required();
  params.add("title", comparison.title);
  params.add("subject", comparison.subject);
  params.add("against", comparison.against);
  declare_runs(params, comparison.runs);
  read_fields(tree, "a comparison", params, {"seeds", "drop", "sequences", "graphs", "skip"}, mistakes_);
  if (!comparison.name.empty()) check_name(comparison.name, place_of(tree, "name"), "comparison name", mistakes_);
  if (comparison.title.empty()) comparison.title = comparison.name;
  read_runs(tree, comparison.runs);
  if (const auto* sequences = field(tree, "sequences", Config::Kind::sequence, mistakes_)) {
    if (sequences->items().empty()) report(sequences->place(), "no sequences are listed; without 'sequences' each graph runs on its own");
    for (const auto& item : sequences->items()) {
      if (!is_map(item, "a sequence", "{name: x, like: FILE}", mistakes_)) continue;
      auto sequence = read_sequence(item);
      check_taken(sequence.name, sequence.place, "sequence", comparison.sequences);
      comparison.sequences.push_back(std::move(sequence));
    }
  }
  if (!tree.find("graphs")) report(tree.place(), "a comparison needs the key 'graphs'");
  if (const auto* graphs = field(tree, "graphs", Config::Kind::sequence, mistakes_)) {
    if (graphs->items().empty()) report(graphs->place(), "the comparison has no graphs");
    for (const auto& item : graphs->items()) {
      if (is_map(item, "a graph", "{name: x, graph: FILE}", mistakes_)) read_graph(item, comparison);
    }
  }
  if (const auto* skipped = field(tree, "skip", Config::Kind::sequence, mistakes_)) read_skipped(*skipped, comparison);
  check_pair(tree, comparison);
  return comparison;
}

void SuiteReader::declare_runs(Params& params, RunSettings& runs) const {
  params.add("threads", runs.threads).range(1, 4096);
  params.add("views", runs.views).range(0, 1000);
  params.add("memory", runs.memory_bytes).unit("bytes").above(0);
  params.add("time_limit", runs.time_limit_s).unit("s").above(0);
}

void SuiteReader::read_runs(const Config& tree, RunSettings& runs) {
  if (const auto* seeds = tree.find("seeds")) read_seeds(*seeds, runs);
  if (const auto* drop = field(tree, "drop", Config::Kind::sequence, mistakes_)) {
    for (auto& word : read_words(*drop, "what is dropped is a node's name or a module", mistakes_)) runs.drop.push_back(std::move(word));
  }
}

void SuiteReader::read_seeds(const Config& seeds, RunSettings& runs) {
  const bool is_list = seeds.kind() == Config::Kind::sequence;
  if (is_list && seeds.items().empty()) report(seeds.place(), "no seeds are listed");
  std::vector<std::uint64_t> read;
  auto count = [&](const Config& value, double least, double most) {
    std::int64_t number = static_cast<std::int64_t>(least);
    Params params;
    params.add("seeds", number).range(least, most);
    Config only = Config::map(value.place());
    only.set("seeds", value.place(), value);
    params.parse(&only, "the suite", value.place(), mistakes_);
    return number;
  };
  if (!is_list) {
    const auto number = count(seeds, 1, kMostSeeds);
    for (std::int64_t s = 1; s <= number; ++s) read.push_back(static_cast<std::uint64_t>(s));
  }
  for (const auto& item : seeds.items()) {
    const auto seed = static_cast<std::uint64_t>(count(item, 0, 9e15));
    if (std::ranges::find(read, seed) != read.end()) report(item.place(), fmt::format("seed {} is there already", seed));
    read.push_back(seed);
  }
  runs.seeds = std::move(read);
}

void SuiteReader::read_slurm(const Config& tree, Suite& suite) {
  if (!is_map(tree, "slurm", "{at_once: 20, options: [--partition=long]}", mistakes_)) return;
  Params params;
  params.add("at_once", suite.slurm_at_once).range(1, 100'000);
  read_fields(tree, "slurm", params, {"options"}, mistakes_);
  const auto* options = field(tree, "options", Config::Kind::sequence, mistakes_);
  if (!options) return;
  for (const auto& [word, place] : read_words(*options, "an option of sbatch is a text such as --partition=long", mistakes_)) {
    if (!word.starts_with("-") || word.find('\n') != std::string::npos)
      report(place, fmt::format("'{}' is no option of sbatch: write it as on its command line, --partition=long", word));
    suite.slurm_options.push_back(word);
  }
}

void SuiteReader::read_skipped(const Config& list, Comparison& comparison) {
  std::vector<std::string> graphs = names_of(comparison), sequences;
  for (const auto& g : comparison.graphs) graphs.push_back(g.base_name);
  for (const auto& s : comparison.sequences) sequences.push_back(s.name);
  if (sequences.empty()) report(list.place(), "nothing can be skipped where there are no sequences");
  for (const auto& item : list.items()) {
    if (!is_map(item, "what is skipped", "{graph: x, sequence: y}", mistakes_)) continue;
    std::string graph, sequence;
    Params params;
    params.add("graph", graph).required();
    params.add("sequence", sequence).required();
    read_fields(item, "what is skipped", params, {}, mistakes_);
    if (!graph.empty() && std::ranges::find(graphs, graph) == graphs.end())
      report(place_of(item, "graph"), none_such("graph", graph, graphs));
    if (!sequence.empty() && !sequences.empty() && std::ranges::find(sequences, sequence) == sequences.end())
      report(place_of(item, "sequence"), none_such("sequence", sequence, sequences));
    comparison.skipped.emplace_back(graph, sequence);
  }
}

void SuiteReader::check_pair(const Config& tree, Comparison& comparison) {
  const auto names = names_of(comparison);
  if (names.empty()) return;
  if (comparison.subject.empty()) comparison.subject = names[0];
  for (const char* key : {"subject", "against"}) {
    const std::string& name = key[0] == 's' ? comparison.subject : comparison.against;
    if (!name.empty() && std::ranges::find(names, name) == names.end()) report(place_of(tree, key), none_such("graph", name, names));
  }
  if (comparison.against == comparison.subject) report(place_of(tree, "against"), "a graph is compared with itself");
  for (const auto& name : names)
    if (comparison.against.empty() && name != comparison.subject) comparison.against = name;
}

Suite read_suite(const std::filesystem::path& file) {
  const Config tree = load_yaml(file);
  SuiteReader reader;
  Suite suite = reader.read(tree);
  suite.file = file;
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  suite.text = text.str();
  if (reader.mistakes().empty()) return suite;
  auto key = [](const Diagnostic& d) { return std::tie(d.place.line, d.place.column); };
  std::ranges::stable_sort(reader.mistakes(), [&](auto& a, auto& b) { return key(a) < key(b); });
  throw ConfigError(std::move(reader.mistakes()));
}

}  // namespace ppm
