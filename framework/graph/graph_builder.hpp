#pragma once
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "framework/graph/facet_state.hpp"
#include "framework/graph/graph.hpp"

namespace ppm {

/// Makes a Graph of a parsed file, collecting every mistake on the way. A step goes on after a mistake with what the
/// writer most likely meant, so that one mistake gives one message.
class GraphBuilder {
 public:
  explicit GraphBuilder(const Registry& registry) : registry_(registry) {}
  Graph build(Config file, const std::vector<Override>& overrides);

 private:
  /// Where a node of graph_.nodes_ is written.
  struct Written {
    const Config* tree;
    Place module;
  };

  // read_graph.cpp: keys, nodes, modules and their parameters
  void read_file(const Config& file);
  std::int64_t read_count(const Config& file, const std::string& key);
  void read_plugins(const Config& list);
  void read_node(const Config& tree);
  void read_node_name(const Config& tree, Node& node);
  void make_module(const Config& tree, Node& node, Place& place);
  void check_keys(const Config& map, const std::string& owner, const std::vector<std::string>& allowed);
  const Config* required(const Config& map, const std::string& owner, const std::string& key, Config::Kind kind);

  // wire_graph.cpp: inputs to the outputs above
  void wire();
  void wire_node(std::size_t i);
  PortBase* find_input(std::size_t i, const Config::Entry& entry);
  const PortBase* find_output(std::size_t i, const Config& source);
  std::string no_node_above(std::size_t i, const std::string& name) const;
  void connect(std::size_t i, PortBase& input, const PortBase& output, const Config& source);
  void use_node(std::size_t i, UsePortBase& input, const Config& named);
  void report_unwired(std::size_t i, const PortBase& input);
  void make_outputs(std::size_t i);
  void check_source(const Config& file);

  // check_facets.cpp: what the belief carries, frame by frame
  void check_facets();
  void enter_node(std::size_t i, std::int64_t frame, FacetState& state);
  std::string missing_facet(std::size_t i, const std::string& need, std::int64_t frame, const FacetState& state) const;
  std::string never_given(const std::string& need) const;
  void check_map_kinds(const Config& file);

  void report(const Place& place, std::string message) { mistakes_.push_back({place, std::move(message)}); }

  const Registry& registry_;
  Graph graph_;
  std::vector<Written> written_;                            // [nodes]
  std::vector<Facets> facets_;                              // [nodes]
  std::set<std::pair<std::size_t, std::string>> reported_;  // node and facet
  bool unknown_module_ = false;                             // a node's module is neither known nor guessed
  Diagnostics mistakes_;
};

/// "; did you mean 'x'?" where a candidate is like the word, else "".
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);
/// The kind of a value in words: "a list".
std::string a_kind(const Config& value);

}  // namespace ppm
