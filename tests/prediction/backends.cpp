#include "tests/prediction/backends.hpp"

#include <algorithm>
#include <iostream>

#include "framework/slam/frame.hpp"
#include "tests/prediction/gl_device.hpp"
#include "tests/support/registry.hpp"

namespace ppm::test {
namespace {

bool has(const std::vector<std::string>& facets, const std::string& facet) {
  return std::find(facets.begin(), facets.end(), facet) != facets.end();
}

bool looks_exactly_at_meshes(const ModuleInfo& info) {
  if (!info.name.starts_with("prediction.")) return false;
  const auto module = info.make();
  for (const PortBase* port : module->ports()) {
    if (port->direction() != PortDirection::belief) continue;
    const auto& facets = static_cast<const BeliefPortBase*>(port)->facets();
    if (has(facets.needs, "map.ppm") && has(facets.gives, "prediction.elements")) return true;
  }
  return false;
}

bool runs_here(const std::string& name) {
  if (name != "prediction.raster_gl" || gl_lacks().empty()) return true;
  std::cout << name << " is left out: " << gl_lacks() << "\n";
  return false;
}

std::string params_of(const Look& look) {
  return fmt::format("{{stride: {}, backfaces: {}}}", look.stride, look.cull_back_faces ? "cull" : "hit");
}

std::vector<PredictionHandle> look_at(Harness& harness, const std::shared_ptr<const Map>& map,
                                      const std::vector<Look>& looks) {
  auto frame = std::make_shared<Frame>();
  frame->camera = looks.front().camera;
  harness.input<Frame>("frame", frame);
  auto& belief = harness.belief();
  belief.init(looks.size(), Pose::Identity(), map);
  for (std::size_t i = 0; i < looks.size(); ++i) belief.pose[i] = looks[i].T_map_camera;
  harness.tick();
  return belief.prediction;
}

}  // namespace

std::vector<std::string> exact_backends() {
  std::vector<std::string> names;
  for (const ModuleInfo* info : builtin().all())
    if (looks_exactly_at_meshes(*info) && runs_here(info->name)) names.push_back(info->name);
  return names;
}

Views deferred_views(const std::string& backend, const std::shared_ptr<const Map>& map, const std::vector<Look>& looks,
                     int threads) {
  Views views{std::make_unique<Harness>(builtin(), backend, params_of(looks.front()), threads), {}};
  views.of = look_at(*views.harness, map, looks);
  return views;
}

PredictionHandle Viewer::see(const Look& look) {
  auto& harness = harness_[params_of(look)];
  if (!harness) harness = std::make_unique<Harness>(builtin(), backend_, params_of(look));
  return filled(look_at(*harness, map_, {look}).front());
}

PredictionHandle filled(const PredictionHandle& view) {
  static PredictionPool pool;
  static const Workers one(1);
  return completed(view, pool, one);
}

}  // namespace ppm::test
