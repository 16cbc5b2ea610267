#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "framework/roles/frame_selection.hpp"

using Indices = std::vector<std::int64_t>;
using Catch::Matchers::Contains;

TEST_CASE("first, last and stride select images") {
  CHECK(ppm::select_frames("s", 5, 0, -1, 1, 0).mapped == Indices{0, 1, 2, 3, 4});
  CHECK(ppm::select_frames("s", 10, 2, 8, 3, 0).mapped == Indices{2, 5, 8});
  CHECK(ppm::select_frames("s", 10, 3, 3, 7, 0).mapped == Indices{3});
  CHECK(ppm::select_frames("s", 10, 0, -1, 1, 0).held_out.empty());
}

TEST_CASE("images are held out by their index, whatever first and stride") {
  const auto all = ppm::select_frames("s", 30, 0, -1, 1, 10);
  CHECK(all.held_out == Indices{5, 15, 25});
  CHECK(all.mapped.size() == 27);
  const auto some = ppm::select_frames("s", 30, 3, 26, 4, 10);
  CHECK(some.held_out == Indices{5, 15, 25});
  CHECK(some.mapped == Indices{3, 7, 11, 19, 23});  // 15 would be next after 11
  CHECK(ppm::select_frames("s", 6, 0, -1, 1, 3).held_out == Indices{1, 4});
}

TEST_CASE("a selection of nothing is an error that says why") {
  CHECK_THROWS_WITH(ppm::select_frames("data/x", 0, 0, -1, 1, 0), Contains("data/x") && Contains("holds no image"));
  CHECK_THROWS_WITH(ppm::select_frames("s", 5, 5, -1, 1, 0), Contains("'first' is 5") && Contains("last image is 4"));
  CHECK_THROWS_WITH(ppm::select_frames("s", 5, 0, 5, 1, 0), Contains("'last' is 5"));
  CHECK_THROWS_WITH(ppm::select_frames("s", 5, 3, 2, 1, 0), Contains("before 'first'"));
  CHECK_THROWS_WITH(ppm::select_frames("s", 20, 5, -1, 10, 10), Contains("none is left to map"));
}

TEST_CASE("holdout is 'none' or an English ordinal") {
  CHECK(ppm::parse_holdout("none") == 0);
  CHECK(ppm::parse_holdout("every 10th") == 10);
  CHECK(ppm::parse_holdout("every 2nd") == 2);
  CHECK(ppm::parse_holdout("every 3rd") == 3);
  CHECK(ppm::parse_holdout("every 11th") == 11);
  CHECK(ppm::parse_holdout("every 21st") == 21);
  CHECK(ppm::parse_holdout("every 112th") == 112);
  for (const char* wrong : {"", "every", "every 10", "every 10nd", "every 1st", "every 0th", "every -2th", "10th",
                            "every 10th image", "every 99999999999999999999th"})
    CHECK(ppm::parse_holdout(wrong) == -1);
}
