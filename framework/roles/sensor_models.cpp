#include "framework/roles/sensor_models.hpp"

#include <algorithm>

#include "framework/roles/map_editor.hpp"
#include "framework/roles/view_predictor.hpp"

namespace ppm {
namespace {

/// The node that a node's frame comes from; null for one that reads none.
const Node* frame_maker(const Graph& graph, const Node& reader) {
  const auto& ports = reader.module->ports();
  for (const auto& edge : reader.edges) {
    const auto port = std::ranges::find_if(ports, [&](const PortBase* p) {
      return p->direction() == PortDirection::in && p->name() == edge.port && p->type() == typeid(Frame);
    });
    if (port == ports.end()) continue;
    const auto name = edge.from.substr(0, edge.from.find('.'));
    const auto maker = std::ranges::find(graph.nodes(), name, &Node::name);
    PPM_CHECK(maker != graph.nodes().end(), "node '{}' reads from '{}', which is not there", reader.name, name);
    return &*maker;
  }
  return nullptr;
}

/// The first node of a kind that reads a frame, or null.
template <class Kind>
const Node* first_reader(const Graph& graph) {
  for (const auto& node : graph.nodes())
    if (dynamic_cast<const Kind*>(node.module.get()) && frame_maker(graph, node)) return &node;
  return nullptr;
}

}  // namespace

std::vector<const SensorModel*> sensor_models(const Graph& graph) {
  const Node* node = first_reader<MapEditor>(graph);
  if (!node) node = first_reader<ViewPredictor>(graph);
  std::vector<const SensorModel*> models;
  while (node && (node = frame_maker(graph, *node)))
    if (auto* model = dynamic_cast<const SensorModel*>(node->module.get())) models.push_back(model);
  std::ranges::reverse(models);
  return models;
}

}  // namespace ppm
