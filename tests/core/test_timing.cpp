#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/timing.hpp"

using namespace ppm;

TEST_CASE("quantiles by nearest rank, and means") {
  const std::vector<double> v{5, 1, 4, 2, 3};
  CHECK(quantile(v, 0) == 1);
  CHECK(quantile(v, 0.2) == 1);
  CHECK(quantile(v, 0.21) == 2);
  CHECK(quantile(v, 0.5) == 3);
  CHECK(quantile(v, 0.99) == 5);
  CHECK(quantile(v, 1) == 5);
  CHECK(mean(v) == 3);
  CHECK(std::isnan(quantile({}, 0.5)));
  CHECK(std::isnan(mean({})));
}
