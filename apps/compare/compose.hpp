#pragma once
#include <string>
#include <vector>

#include "apps/compare/suite.hpp"

namespace ppm {

/// What gives frames in a graph, and what of it the other nodes read.
struct FrameNodes {
  std::vector<Config> nodes;
  Config frame;  ///< "node.output"
};

/// The nodes of modules source.*, preprocess.* and sensor.* of a parsed graph file, in their order, and the last one's frame.
FrameNodes frame_nodes(const Config& graph);

/// How a graph of a suite becomes an experiment.
struct Composition {
  std::vector<Config> replace;         ///< nodes in place of those of the same name
  std::vector<AddedNode> add;
  const FrameNodes* frames = nullptr;  ///< in place of the graph's own; null: those stay
  std::vector<std::string> drop;       ///< names or modules; those that the graph has not are ignored
  std::vector<Override> set;           ///< in this order, the last one wins
};

/// The experiment: `graph` (a parsed file) with nodes replaced and added; then its frame nodes replaced, at the place of the first of
/// them, and every input that read from one of them wired to the new frame; less the dropped nodes; with values set; with the paths of
/// its plug-ins made absolute, so that it can be written anywhere; without a seed. What is not as a graph file has to be is left as it
/// is: building the graph says so. Appends mistakes: a node that is to be replaced, followed or set, and is not there.
Config compose(Config graph, const std::string& name, const Composition& how, Diagnostics& mistakes);

/// True where a node (of a graph file) is what `word` says: its name or its module.
bool is_node(const Config& node, const std::string& word);

}  // namespace ppm
