#include "framework/graph/particle_loop.hpp"

#include "framework/core/timing.hpp"
#include "framework/graph/error_context.hpp"

namespace ppm {

bool ParticleLoop::feeds(const Node& node) const {
  for (const auto& edge : node.edges) {
    for (const auto& m : members_) {
      if (edge.from.substr(0, edge.from.find('.')) == m.node->name) return true;
    }
  }
  return false;
}

void ParticleLoop::tick(std::size_t particle, int worker, std::vector<double>& ms) {
  Stopwatch watch;
  double last = 0;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    auto& m = members_[k];
    in_node(
        *m.node, [&] { return fmt::format("frame {}, particle {}", m.context->frame(), particle); },
        [&] { m.module->tick(*m.context, particle, worker); });
    double now = watch.ms();
    ms[k] += now - last;
    last = now;
  }
}

void ParticleLoop::run(ParticleSet* release) {
  auto serial = [&](Member& m, void (ParticleModule::*hook)(Context&)) {
    Stopwatch watch;
    in_node(
        *m.node, [&] { return fmt::format("frame {}", m.context->frame()); }, [&] { (m.module->*hook)(*m.context); });
    m.ms += watch.ms();
  };
  for (auto& m : members_) serial(m, &ParticleModule::before);

  const Workers& workers = members_.front().context->workers();
  PerWorker<std::vector<double>> spent;
  spent.resize(workers.threads());
  for (auto& ms : spent) ms.resize(members_.size());
  Stopwatch watch;
  workers.for_each(members_.front().module->particles().size(), [&](std::size_t particle, int worker) {
    tick(particle, worker, spent[worker]);
    if (release) release->prediction[particle].reset();
  });
  const double wall = watch.ms();

  std::vector<double> sum(members_.size());
  double total = 0;
  for (const auto& ms : spent) {
    for (std::size_t k = 0; k < ms.size(); ++k) {
      sum[k] += ms[k];
      total += ms[k];
    }
  }
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (total > 0) members_[k].ms += wall * sum[k] / total;
  }

  for (auto& m : members_) serial(m, &ParticleModule::after);
}

}  // namespace ppm
