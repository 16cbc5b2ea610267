#pragma once
#include <span>

namespace ppm {

/// The largest exponent of a likelihood, in [least, 1], that leaves an effective sample size of at least `ess_target`: of
/// weights exp(log_weight + exponent * log_likelihood), normalised. `least` where none does, as where the weights before
/// are too uneven already. Found by halving, in so many steps whatever the numbers are.
/// Entries may be -infinity (weight 0); at least one sum is finite.
/// Source: Del Moral, Doucet, Jasra, "An adaptive sequential Monte Carlo method for approximate Bayesian computation",
/// Statistics and Computing 2012, section 2; Chopin, Papaspiliopoulos, "An Introduction to Sequential Monte Carlo", 2020,
/// section 17.2.
double temper_for_ess(std::span<const double> log_weight, std::span<const double> log_likelihood, double ess_target,
                      double least);

}  // namespace ppm
