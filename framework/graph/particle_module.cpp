#include "framework/graph/particle_module.hpp"

namespace ppm {

void ParticleModule::tick(Context& context) {
  before(context);
  context.workers().for_each(particles().size(),
                             [&](std::size_t particle, int worker) { tick(context, particle, worker); });
  after(context);
}

}  // namespace ppm
