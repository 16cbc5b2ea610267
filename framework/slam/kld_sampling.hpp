#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "framework/core/rng.hpp"
#include "framework/core/se3.hpp"

namespace ppm {

/// z with P(Z <= z) = p for a standard normal Z; p in (0, 1).
double normal_quantile(double p);

/// How many draws from a distribution over k bins keep the Kullback-Leibler divergence between their share in each bin and
/// the distribution at or below `error` with the probability that z is the normal quantile of: chi2(k - 1) / (2 error), the
/// quantile of chi2 by Wilson and Hilferty. 1 for k <= 1.
/// Source: Fox, "Adapting the sample size in particle filters through KLD-sampling", IJRR 2003, equation 14.
double kld_bound(std::size_t k, double error, double z);

/// The bin of each pose in a grid over its six degrees of freedom, seen from `origin`: numbers from 0, in the order in which
/// bins are first met. bin_t: m, along each axis of origin; bin_r: rad, of each entry of the rotation vector.
std::vector<std::uint32_t> pose_bins(std::span<const Pose> poses, const Pose& origin, double bin_t, double bin_r);

/// What the number of particles is to guarantee, and its bounds.
struct KldLimits {
  double error = 0.05;     ///< divergence, nats
  double z = 2.326;        ///< normal quantile of the probability that it holds
  std::size_t least = 20, most = 500;
};

/// The number of draws at which KLD-sampling stops: particles are drawn one by one by their weights, and the bins that
/// they fall into counted, until there are as many draws as kld_bound() asks for that many bins.
/// weights: not negative, one at least positive; bins: see pose_bins().
std::size_t kld_number(std::span<const double> weights, std::span<const std::uint32_t> bins, const KldLimits& limits, Rng rng);

}  // namespace ppm
