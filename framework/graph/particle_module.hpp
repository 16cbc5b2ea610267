#pragma once
#include "framework/graph/module.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// A module that works on one particle at a time. The executor runs consecutive ones as one parallel loop over
/// particles, so that a particle's data stays in the core's cache from node to node:
///   a.before, b.before; for each particle, in parallel: a.tick(i), b.tick(i); a.after, b.after.
/// tick(i) reads and writes particle i only, and gives the same bytes on any thread and in any order.
class ParticleModule : public Module {
 public:
  /// Work for all particles before the loop (shared, read-only in the loop). Runs before the ticks of the nodes above
  /// it in the same loop, so it may not read what they write, unless starts_loop() says so.
  virtual void before(Context&) {}
  virtual void tick(Context& context, std::size_t particle, int worker) = 0;
  /// Work for all particles after the loop, in fixed order.
  virtual void after(Context&) {}
  /// True where before() reads poses, maps or weights that nodes above may change in their ticks: the loop above ends
  /// first.
  virtual bool starts_loop() const { return false; }
  /// True where a later node needs what after() does: the loop ends with this node.
  virtual bool ends_loop() const { return false; }

  /// The loop of this module alone.
  void tick(Context& context) final;
  /// The belief that the loop runs over.
  virtual const ParticleSet& particles() const = 0;
};

}  // namespace ppm
