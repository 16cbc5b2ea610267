#pragma once
#include <vector>

#include "framework/graph/graph.hpp"

namespace ppm {

/// Puts values in place of those of a parsed graph file, a map. Appends every mistake: a node that the file has not ("did you
/// mean"). Whether the node has such a parameter, and the value fits it, is seen when the graph is built.
void apply_overrides(const std::vector<Override>& overrides, Config& file, Diagnostics& mistakes);

}  // namespace ppm
