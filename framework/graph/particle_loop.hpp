#pragma once
#include <vector>

#include "framework/graph/graph.hpp"
#include "framework/graph/particle_module.hpp"

namespace ppm {

/// One parallel loop over particles for several nodes (see ParticleModule).
class ParticleLoop {
 public:
  struct Member {
    const Node* node;
    ParticleModule* module;
    Context* context;
    double ms = 0;  ///< wall time of before() and after(), and its share of the loop's
  };
  void add(const Node& node, ParticleModule& module, Context& context) {
    members_.push_back({&node, &module, &context});
  }
  /// True when a node above in this loop makes an input of `node`: the input is there only after the loop.
  bool feeds(const Node& node) const;
  /// release: nothing after the loop reads what it predicted; each particle lets go of its prediction after its ticks,
  /// so that the next one's is made in the same memory, which is in the core's cache.
  void run(ParticleSet* release = nullptr);
  const std::vector<Member>& members() const { return members_; }

 private:
  void tick(std::size_t particle, int worker, std::vector<double>& ms);
  std::vector<Member> members_;
};

}  // namespace ppm
