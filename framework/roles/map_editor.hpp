#pragma once
#include "framework/graph/particle_module.hpp"
#include "framework/slam/map.hpp"

namespace ppm {

/// Base of modules that change maps as a pure function of (map, pose, prediction): particles that agree in all three (copies
/// of one ancestor after resampling) are computed once and share the result. Draws no random numbers.
class MapEditor : public ParticleModule {
 public:
  InOut<Belief> belief;

  /// The map of particle i after the edit. Reads other particles' data never. May return the map it was given (no change).
  /// `map` is the particle's handle, moved in: where it is the only one, its memory may be reused.
  virtual MapHandle edit(Context& context, std::size_t particle, MapHandle map, int worker) = 0;

  void before(Context& context) override;
  using ParticleModule::tick;
  void tick(Context& context, std::size_t particle, int worker) override;
  void after(Context& context) override;
  bool ends_loop() const override { return true; }
  const ParticleSet& particles() const override { return *belief; }

 protected:
  explicit MapEditor(Facets facets) : belief(this, std::move(facets)) {}

 private:
  std::vector<std::size_t> leader_;  // for each particle the lowest particle with the same map, pose and prediction
};

}  // namespace ppm
