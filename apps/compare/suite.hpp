#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/graph/graph.hpp"

namespace ppm {

/// How each run of a comparison is made. A comparison starts with those of its suite.
struct RunSettings {
  std::vector<std::uint64_t> seeds{1};
  int threads = 1;
  int views = 0;                                     ///< held-out frames of which a run leaves pictures
  double memory_bytes = 1024.0 * 1024 * 1024;        ///< expected of a run, until one has been measured
  double time_limit_s = 24 * 3600.0;                 ///< a run that takes longer is ended, and has failed
  std::vector<std::pair<std::string, Place>> drop;   ///< nodes that are left out: names, or modules
};

/// Frames that graphs are run on in place of their own.
struct SuiteSequence {
  std::string name, title;
  Place place;
  Config nodes;                  ///< list of nodes; null where they are those of another graph
  std::filesystem::path like;    ///< that graph, or empty
  Place like_place;
  Config frame;                  ///< "node.output" of the frames that are read, or null: the last node's frame
  std::vector<Override> set;
  std::vector<Override> seeded;  ///< parameters that get the run's seed too; the values are "node.key" as written
};

/// A node that a graph of a suite has besides those of its file.
struct AddedNode {
  std::string after;  ///< the node that it follows
  Place place;
  Config node;
};

/// One graph of a comparison; one value of a sweep is a graph of its own.
struct SuiteGraph {
  std::string name;       ///< "ppm", of a sweep "ppm_t[init.texel_size=1 cm]"
  std::string base_name;  ///< as it is written in the suite
  std::string title;
  Place place;
  std::filesystem::path file;
  Place file_place;
  std::vector<Config> replace;  ///< nodes in place of those of the same name
  std::vector<AddedNode> add;
  std::vector<Override> set;
  std::map<std::string, std::vector<Override>> set_for;  ///< by the name of a sequence
  std::vector<Override> sweep;                           ///< its point of the sweep
  std::vector<std::pair<std::string, Place>> drop;
  double memory_bytes = 0;  ///< 0: as the comparison has it
  bool optional = false;    ///< left out where this ppm lacks a module of it
};

struct Comparison {
  std::string name, title;
  Place place;
  std::string subject, against;  ///< names of graphs; `against` is "" where there is no second one
  RunSettings runs;
  std::vector<SuiteSequence> sequences;  ///< none: each graph runs on its own frames
  std::vector<SuiteGraph> graphs;
  std::vector<std::pair<std::string, std::string>> skipped;  ///< names of a graph and a sequence

  bool skips(const SuiteGraph& graph, const std::string& sequence) const;
};

/// A comparison of graphs on sequences, for several seeds: docs/compare.md.
struct Suite {
  std::string name, title;
  std::filesystem::path file;
  std::string text;  ///< of the file
  std::vector<Comparison> comparisons;
  std::vector<std::string> slurm_options;  ///< of the exported job array: "--partition=long"
  int slurm_at_once = 0;                   ///< tasks of the array side by side; 0: as many as the cluster gives
};

/// Reads and checks a suite file. Throws one ConfigError with every mistake of the file. The graphs that it names are not read.
Suite read_suite(const std::filesystem::path& file);

/// The name of what stands for `sequences` in a comparison that has none.
inline constexpr const char* kOwnFrames = "own";

}  // namespace ppm
