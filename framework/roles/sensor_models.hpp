#pragma once
#include <vector>

#include "framework/graph/graph.hpp"
#include "framework/roles/frame_filter.hpp"

namespace ppm {

/// The sensor models that stand between the graph's source and what is mapped: those that a frame passes on its way to
/// the first MapEditor that reads frames, or, in a graph without one, to the first ViewPredictor. In the order of the
/// nodes. `when:` does not count: the model is taken to hold in every frame.
std::vector<const SensorModel*> sensor_models(const Graph& graph);

}  // namespace ppm
