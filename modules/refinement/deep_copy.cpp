#include <algorithm>

#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace {

using namespace ppm;

/// Gives each particle a map of its own: what a filter does that knows no sharing between particles of one ancestor. For
/// measuring what sharing is worth, in memory and in time; stands behind the resampling. Estimates do not change.
/// source  paper, section 5 (which asks for the contrary)
class DeepCopy final : public Module {
 public:
  InOut<Belief> belief{this, {{"map.ppm"}, {}, {"prediction"}}};

  void tick(Context& context) override {
    auto& maps = belief->map;
    context.workers().for_each(maps.size(), [&](std::size_t i, int) {
      maps[i] = static_cast<const PpmMap&>(*maps[i]).unshared();
    });
    std::ranges::fill(belief->prediction, nullptr);
  }
};

}  // namespace

PPM_MODULES(r) {
  r.add<DeepCopy>("refinement.deep_copy",
                  "Gives each particle a map that shares nothing: to measure what sharing is worth.",
                  "paper, section 5 (the contrary of its trees)");
}
