#include <catch2/catch.hpp>
#include <vector>

#include "framework/core/error.hpp"
#include "framework/core/rng.hpp"
#include "modules/prediction/range_allocator.hpp"

using namespace ppm;

TEST_CASE("ranges are handed out lowest first, and neighbours that come back are one") {
  RangeAllocator ranges;
  CHECK_FALSE(ranges.take(1));
  ranges.grow(10);
  CHECK(ranges.take(4) == 0u);
  CHECK(ranges.take(4) == 4u);
  CHECK_FALSE(ranges.take(4));
  ranges.grow(12);  // the two that were left and two more
  CHECK(ranges.take(4) == 8u);
  CHECK(ranges.used() == 12);
  ranges.give_back(0, 4);
  ranges.give_back(8, 4);
  CHECK_FALSE(ranges.take(5));
  ranges.give_back(4, 4);
  CHECK(ranges.take(12) == 0u);
  CHECK_THROWS_AS(ranges.give_back(4, 10), InternalError);
}

TEST_CASE("no element is handed out twice") {
  RangeAllocator ranges;
  ranges.grow(500);
  Rng rng(2, 0, 0, 0);
  std::vector<bool> taken(500, false);
  std::vector<std::pair<std::size_t, std::size_t>> held;
  for (int i = 0; i < 2000; ++i) {
    const auto count = 1 + static_cast<std::size_t>(30 * rng.uniform());
    const auto first = rng.uniform() < 0.55 ? ranges.take(count) : std::nullopt;
    if (first) {
      held.emplace_back(*first, count);
      for (std::size_t k = *first; k < *first + count; ++k) {
        REQUIRE_FALSE(taken[k]);
        taken[k] = true;
      }
    } else if (!held.empty()) {
      const auto back = held.begin() + static_cast<std::ptrdiff_t>(rng.uniform() * static_cast<double>(held.size()));
      ranges.give_back(back->first, back->second);
      std::fill_n(taken.begin() + static_cast<std::ptrdiff_t>(back->first), back->second, false);
      held.erase(back);
    }
    CHECK(ranges.used() == static_cast<std::size_t>(std::count(taken.begin(), taken.end(), true)));
  }
}
