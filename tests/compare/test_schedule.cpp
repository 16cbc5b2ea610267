#include <catch2/catch.hpp>

#include "apps/compare/job_choice.hpp"
#include "apps/compare/schedule.hpp"

using namespace ppm;

namespace {

constexpr double kGB = 1e9;

Job job(int id, const std::string& graph, std::uint64_t seed, int threads = 1, double bytes = kGB) {
  return {id, "c", "s", graph, seed, "runs/c/s/" + graph + "/seed_" + std::to_string(seed), threads, 0, bytes, 60, ""};
}

/// Ids of the jobs that start now.
std::vector<int> started(Schedule& schedule) {
  std::vector<int> ids;
  while (const auto next = schedule.start()) ids.push_back(next->id);
  return ids;
}

}  // namespace

TEST_CASE("jobs side by side take no more threads than there are cores") {
  Schedule schedule({job(0, "a", 1, 2), job(1, "a", 2, 2), job(2, "b", 1, 1), job(3, "b", 2, 1)}, {3, 0, 100 * kGB});
  CHECK(started(schedule) == std::vector<int>{0, 2});
  schedule.ended(job(2, "b", 1, 1));
  CHECK(started(schedule) == std::vector<int>{3});
  schedule.ended(job(0, "a", 1, 2));
  CHECK(started(schedule) == std::vector<int>{1});
  CHECK(schedule.waiting() == 0);
  CHECK(schedule.running() == 2);
}

TEST_CASE("a number of jobs takes the place of the limit by cores") {
  Schedule schedule({job(0, "a", 1, 2), job(1, "a", 2, 2), job(2, "a", 3, 2)}, {1, 2, 100 * kGB});
  CHECK(started(schedule) == std::vector<int>{0, 1});
}

TEST_CASE("jobs side by side take no more memory than there is, one that needs more than all runs alone") {
  Schedule schedule({job(0, "a", 1, 1, 3 * kGB), job(1, "b", 1, 1, 9 * kGB), job(2, "c", 1, 1, 2 * kGB)}, {8, 0, 5 * kGB});
  CHECK(started(schedule) == std::vector<int>{0, 2});
  schedule.ended(job(0, "a", 1));
  CHECK(started(schedule).empty());
  schedule.ended(job(2, "c", 1));
  CHECK(started(schedule) == std::vector<int>{1});
}

TEST_CASE("measured memory takes the place of what was expected") {
  Schedule schedule({job(0, "a", 1, 1, kGB), job(1, "a", 2, 1, kGB), job(2, "a", 3, 1, kGB)}, {8, 0, 5 * kGB});
  schedule.measured(job(9, "a", 9), 10, 2 * kGB);
  schedule.measured(job(8, "a", 8), 10, 1 * kGB);
  CHECK(schedule.expected_memory(job(0, "a", 1)) == 2 * kGB);
  CHECK(started(schedule) == std::vector<int>{0, 1});
}

TEST_CASE("time left is known as soon as something was measured") {
  Schedule schedule({job(0, "a", 1), job(1, "a", 2), job(2, "b", 1), job(3, "b", 2)}, {2, 0, 100 * kGB});
  CHECK(started(schedule) == std::vector<int>{0, 1});
  CHECK_FALSE(schedule.seconds_left({}));
  schedule.ended(job(0, "a", 1));
  schedule.measured(job(0, "a", 1), 10, kGB);
  CHECK(*schedule.seconds_left({{1, 6.0}}) == Approx((4 + 10 + 10) / 2.0));  // b is expected to be like a
  schedule.measured(job(7, "b", 7), 100, kGB);
  CHECK(*schedule.seconds_left({{1, 6.0}}) == Approx((4 + 100 + 100) / 2.0));
}

TEST_CASE("the first seed of everything comes first") {
  std::vector<int> ids;
  for (const auto& j : in_order_of_seeds({job(0, "a", 7), job(1, "a", 3), job(2, "b", 3), job(3, "b", 1)})) ids.push_back(j.id);
  CHECK(ids == std::vector<int>{0, 2, 1, 3});
}

TEST_CASE("which jobs a pattern means") {
  auto swept = job(0, "ppm[init.texel_size=1 cm]", 2);
  swept.folder = "runs/c/s/ppm_init.texel_size=1_cm/seed_2";
  CHECK(is_meant(swept, "c"));
  CHECK(is_meant(swept, "*/s"));
  CHECK(is_meant(swept, "c/s/ppm*/2"));
  CHECK(is_meant(swept, "c/s/ppm[init.texel_size=1 cm]"));
  CHECK(is_meant(swept, "c/s/ppm_init.texel_size=1_cm"));
  CHECK_FALSE(is_meant(swept, "c/s/ppm*/1"));
  CHECK_FALSE(is_meant(swept, "c/t"));
  CHECK_FALSE(is_meant(swept, "c/s/ppm"));
  CHECK_FALSE(is_meant(swept, "c/s/*/2/x"));
}
