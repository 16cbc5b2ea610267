#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "framework/core/rng.hpp"
#include "framework/graph/module.hpp"
#include "framework/roles/particle_number.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// Which particle's share of the sum of all weights holds each of some points. points: ascending, in [0, 1) of the sum.
/// weights: not negative, one at least positive; a particle without weight is never taken, not even by rounding.
/// Returns ascending numbers.
std::vector<std::uint32_t> particles_at(std::span<const double> points, std::span<const double> weights);

/// n independent uniform numbers in [0, 1), ascending; n + 1 draws.
std::vector<double> sorted_uniforms(std::size_t n, Rng& rng);

/// Base of every `resampling.*`: replaces the particles by n draws from themselves where the weights have become uneven, or
/// another number of particles is wanted (see ParticleNumber); log weights become -log n. Every draw gives particle i n w_i
/// copies on average; modules differ in how far chance departs from that.
///
/// belief   needs normalised weights; every column moves
///
/// metrics  ess: effective sample size before; resampled: 1 or 0; ancestors: distinct particles that live on; particles:
///          number before; drawn: number after
class Resampler : public Module {
 public:
  InOut<Belief> belief{this, {{"belief"}, {}, {}}};
  void open(Context&) final { number_.open(); }
  void tick(Context& context) final;

 protected:
  Resampler();
  /// The ancestors of n new particles, ascending. weights: sum to one within rounding.
  virtual std::vector<std::uint32_t> draw(std::span<const double> weights, std::size_t n, Rng rng) const = 0;

 private:
  double ess_below_ = 0.5;
  ParticleNumber number_;
};

}  // namespace ppm
