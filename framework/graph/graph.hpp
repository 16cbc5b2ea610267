#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/config.hpp"
#include "framework/graph/gate.hpp"
#include "framework/graph/registry.hpp"

namespace ppm {

struct Node {
  std::string name;
  std::string module_name;
  Gate gate;
  Place place;
  std::unique_ptr<Module> module;
  struct Edge {
    std::string port, from;  ///< own input port; "node.port" above, or the "node" that it calls
  };
  std::vector<Edge> edges;
};

/// One `--set node.key=value`.
struct Override {
  std::string node, key;
  Config value;  ///< its place says "--set node.key=value" and the column of the value
};
/// Parses "node.key=value" (also "seed=7"): throws ConfigError.
Override parse_override(const std::string& text);

/// A program of modules, wired and checked, with parameters set: all that can be known before the first frame has been
/// checked.
class Graph {
 public:
  Graph();
  Graph(Graph&&) noexcept;
  Graph& operator=(Graph&&) noexcept;
  ~Graph();
  /// Builds from a parsed file. Throws one ConfigError with every mistake of the file.
  static Graph build(const Config& file, const Registry& registry, const std::vector<Override>& overrides = {});

  const std::string& name() const { return name_; }
  std::uint64_t seed() const { return seed_; }
  /// Frames between checkpoints; 0: none.
  std::int64_t checkpoint_every() const { return checkpoint_every_; }
  /// How the maps that its modules make are kept in checkpoints.
  const MapCodecs& map_kinds() const { return map_kinds_; }
  std::vector<Node>& nodes() { return nodes_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  /// The module of the first node that is a T, or null.
  template <class T>
  T* first() const {
    for (const auto& n : nodes_)
      if (auto* t = dynamic_cast<T*>(n.module.get())) return t;
    return nullptr;
  }
  /// The graph as it runs: every parameter of every node with its value in force. Loading it gives the same graph.
  std::string effective_yaml() const;
  /// The same without what has no influence on results (checkpoint_every): what a run and its continuation must agree in.
  std::string experiment_yaml() const;
  /// The `plugins:` of a graph file, to be loaded before build(): names of shipped ones as they are, files as absolute
  /// paths. A relative path starts at the file's folder.
  static std::vector<std::pair<std::filesystem::path, Place>> plugins(const Config& file);

 private:
  friend class GraphBuilder;
  friend class Executor;
  Config effective(std::int64_t checkpoint_every) const;
  std::string name_;
  std::uint64_t seed_ = 0;
  std::int64_t checkpoint_every_ = 0;
  MapCodecs map_kinds_;
  std::vector<std::filesystem::path> plugins_;  // absolute, or names of shipped ones
  std::vector<Node> nodes_;
  std::vector<std::unique_ptr<std::shared_ptr<const void>>> slots_;
  std::unique_ptr<ParticleSet> belief_;
};

}  // namespace ppm
