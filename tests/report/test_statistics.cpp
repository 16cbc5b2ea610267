#include <catch2/catch.hpp>
#include <limits>

#include "apps/report/statistics.hpp"

using namespace ppm::report;

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
}

TEST_CASE("the median of odd and even numbers of values, infinite ones included") {
  CHECK(median({3}) == 3);
  CHECK(median({5, 1, 2}) == 2);
  CHECK(median({4, 1, 2, 8}) == 3);
  CHECK(median({1, 2, kInfinity}) == 2);
  CHECK(median({1, kInfinity}) == kInfinity);
  CHECK(median({kInfinity, kInfinity}) == kInfinity);
  CHECK(median({-kInfinity, kInfinity}) == 0);
}

TEST_CASE("binomial tails by hand") {
  CHECK(binomial_tail(-1, 5) == 0);
  CHECK(binomial_tail(0, 5) == 1.0 / 32);
  CHECK(binomial_tail(1, 5) == 6.0 / 32);
  CHECK(binomial_tail(5, 5) == 1);
}

TEST_CASE("confidence intervals of the median have the levels of the binomial distribution") {
  CHECK_FALSE(median_interval({7}));
  auto check = [](std::vector<double> values, double low, double high, double level) {
    const auto interval = median_interval(std::move(values));
    REQUIRE(interval);
    CHECK(interval->low == low);
    CHECK(interval->high == high);
    CHECK(interval->level == Approx(level).margin(1e-12));
  };
  check({2, 1}, 1, 2, 0.5);
  check({5, 3, 1, 2, 4}, 1, 5, 0.9375);
  check({1, 2, 3, 4, 5, 6}, 1, 6, 0.96875);
  check({1, 2, 3, 4, 5, 6, 7, 8}, 1, 8, 0.9921875);          // the 2nd and 7th would hold it with 0.93 alone
  check({1, 2, 3, 4, 5, 6, 7, 8, 9}, 2, 8, 1 - 20.0 / 512);  // tabulated: 0.961
  check({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, 2, 9, 1 - 22.0 / 1024);
}

TEST_CASE("the sign test by hand") {
  CHECK(sign_test({}) == 1);
  CHECK(sign_test({0, 0}) == 1);
  CHECK(sign_test({1, 2, 3, 4, 5}) == Approx(2.0 / 32));
  CHECK(sign_test({-1, 2, 3, 4, 5}) == Approx(12.0 / 32));
  CHECK(sign_test({-1, 1}) == 1);
  CHECK(sign_test({-1, -1, -1, 0, -kInfinity}) == Approx(2.0 / 16));
}
