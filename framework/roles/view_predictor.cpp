#include "framework/roles/view_predictor.hpp"

#include <algorithm>
#include <unordered_set>

#include "framework/roles/twins.hpp"

namespace ppm {

ViewPredictor::ViewPredictor(const std::string& map_facet) : belief(this, {{map_facet}, {"prediction"}, {}}) {
  params_.add("stride", stride_).range(1, 64).doc("Predicts each n-th pixel of each n-th row of the frame.");
}

void ViewPredictor::before(Context& context) {
  auto& particles = *belief;
  std::vector<const Map*> maps;
  std::unordered_set<const Map*> seen;
  for (const auto& map : particles.map)
    if (seen.insert(map.get()).second) maps.push_back(map.get());
  prepare(maps, context.workers());

  // Views that several particles share are there before the loop; the loop makes each particle's own.
  particles.prediction.assign(particles.size(), nullptr);
  const auto leader = twins(particles, false);
  std::vector<std::size_t> shared;
  for (std::size_t i = 0; i < leader.size(); ++i)
    if (leader[i] != i) shared.push_back(leader[i]);
  std::sort(shared.begin(), shared.end());
  shared.erase(std::unique(shared.begin(), shared.end()), shared.end());
  context.workers().for_each(
      shared.size(), [&](std::size_t k, int worker) { particles.prediction[shared[k]] = view(shared[k], worker); });
  for (std::size_t i = 0; i < leader.size(); ++i) particles.prediction[i] = particles.prediction[leader[i]];
}

void ViewPredictor::tick(Context&, std::size_t particle, int worker) {
  auto& prediction = belief->prediction[particle];
  if (!prediction) prediction = view(particle, worker);
}

PredictionHandle ViewPredictor::view(std::size_t particle, int worker) {
  auto out = pool_.take();
  out->reset(frame->camera, stride_, belief->pose[particle]);
  predict(*belief->map[particle], *out, worker);
  return out;
}

}  // namespace ppm
