#pragma once
#include <cstddef>
#include <numbers>
#include <span>

#include "framework/config/params.hpp"
#include "framework/core/rng.hpp"
#include "framework/slam/kld_sampling.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// How many particles there are to be after a resampling.
/// kept   as many as before
/// fixed  a given number, to which a belief comes back that a proposal or a recovery has made larger or smaller
/// kld    as many as represent the spread of the poses: Fox's bound, over bins of the pose
/// need   few where the best particle's map explains the frame and the particles agree, many where the share of outliers
///        says that it does not, or several places are in question: least (most / least)^u with u from 0 to 1 as the
///        outliers go from `outliers_few` to `outliers_many`, and `per_place` for each cluster of poses
/// Of a belief that is lost, kld and need ask for the fewest: its particles stand for nothing, and a recovery.* node searches.
class ParticleNumber {
 public:
  void declare(Params& params);
  /// Throws ConfigError where parameters contradict each other.
  void open();
  /// weights: of the belief, not logs. Throws ConfigError where the belief lacks what the number follows.
  std::size_t wanted(ParticleSet& belief, std::span<const double> weights, Rng rng) const;

 private:
  enum class Rule { kept, fixed, kld, need };
  std::size_t by_spread(const ParticleSet& belief, std::span<const double> weights, Rng rng) const;
  std::size_t by_need(ParticleSet& belief, std::span<const double> weights) const;

  Rule rule_ = Rule::kept;
  int fixed_ = 0, least_ = 20, most_ = 500, per_place_ = 10;
  KldLimits kld_;
  double quantile_ = 0.99;
  double bin_t_ = 0.05, bin_r_ = 2 * std::numbers::pi / 180;
  double outliers_few_ = 0.05, outliers_many_ = 0.13;
  double slack_ = 0.2, fall_ = 0.5;
};

}  // namespace ppm
