#include "framework/roles/map_editor.hpp"

#include "framework/roles/twins.hpp"

namespace ppm {

namespace {

Facets with_predictions_dropped(Facets facets) {
  facets.drops.push_back("prediction");
  return facets;
}

}  // namespace

MapEditor::MapEditor(Facets facets, EditReads reads)
    : belief(this, with_predictions_dropped(std::move(facets))), reads_(reads) {}

void MapEditor::tick(Context& context) {
  before(context);
  auto& particles = *belief;
  const auto leader = reads_ == EditReads::map ? map_twins(particles) : twins(particles, true);
  std::vector<std::size_t> leaders;
  for (std::size_t i = 0; i < leader.size(); ++i) {
    if (leader[i] == i)
      leaders.push_back(i);
    else
      particles.map[i].reset();  // followers let go, so that their leader's handle may be the only one
  }
  context.workers().for_each(leaders.size(), [&](std::size_t k, int worker) {
    auto& map = particles.map[leaders[k]];
    map = edit(context, leaders[k], std::move(map), worker);
    PPM_CHECK(map, "the edit of particle {} gave no map", leaders[k]);
  });
  for (std::size_t i = 0; i < leader.size(); ++i) {
    particles.map[i] = particles.map[leader[i]];
    edited(i, leader[i]);
  }
  particles.prediction.assign(particles.size(), nullptr);
}

}  // namespace ppm
