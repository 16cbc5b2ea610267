#pragma once
#include <optional>
#include <vector>

namespace ppm::report {

/// Values may be infinite (a run that failed is infinitely bad), never NaN.

/// The middle value; of an even number of them the mean of the two in the middle. Throws InternalError where there are
/// none.
double median(std::vector<double> values);

/// Bounds of a median, and the probability that they hold it.
struct Interval {
  double low, high;
  double level;
};

/// Confidence interval of the median from order statistics: exact for continuous distributions of any form,
/// conservative for others. [x(k), x(n+1-k)] holds the median with probability 1 - 2 P(B <= k-1), B binomial(n, 1/2);
/// the largest k that gives `wanted` is taken, and k = 1 (smallest to largest, its own level) where none does. None for
/// fewer than two values. source: David and Nagaraja, Order Statistics, 3rd edition (2003), section 7.1
std::optional<Interval> median_interval(std::vector<double> values, double wanted = 0.95);

/// Exact two-sided sign test: the probability of signs at least as uneven as these where neither is likelier. Zeros are
/// left out; 1 where nothing is left. source: Dixon and Mood, The statistical sign test, JASA 41 (1946)
double sign_test(const std::vector<double>& differences);

/// P(B <= k) for B binomial(n, 1/2); 0 for k < 0.
double binomial_tail(int k, int n);

}  // namespace ppm::report
