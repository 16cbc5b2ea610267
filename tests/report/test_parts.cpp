#include <catch2/catch.hpp>

#include "apps/report/axis.hpp"
#include "apps/report/bands.hpp"
#include "apps/report/config_changes.hpp"
#include "apps/report/equal_cost.hpp"
#include "apps/report/html_text.hpp"

using namespace ppm::report;

TEST_CASE("axes end at round numbers and are marked at them") {
  const Axis linear({0.3, 9.7}, Scale::linear);
  CHECK(linear.ticks() == std::vector<double>{0, 2, 4, 6, 8, 10});
  CHECK(linear.at(5) == Approx(0.5));
  CHECK(linear.at(-1) == 0);
  const Axis logarithmic({3, 80}, Scale::logarithmic);
  CHECK(logarithmic.ticks().front() == 2);
  CHECK(logarithmic.ticks().back() == Approx(100));
  CHECK(logarithmic.at(std::sqrt(200)) == Approx(0.5));
  CHECK(Axis({8.9, 9.3}, Scale::logarithmic).ticks() == std::vector<double>{8, 9, 10});
  CHECK(Axis({0, 1, 1e6}, Scale::logarithmic).at(0) == 0);  // no logarithm: at the low end
  CHECK(Axis({4}, Scale::linear).ticks().size() > 1);
  CHECK(tick_text(0.05) == "0.05");
}

TEST_CASE("fronts: what no other beats, read between and bounded beyond") {
  const auto front = front_of({{"c", 8, 5}, {"a", 2, 20}, {"bad", 4, 30}, {"b", 4, 10}});
  REQUIRE(front.size() == 3);
  CHECK(front[1].graph == "b");
  CHECK(error_at(front, 4).value == 10);
  CHECK(error_at(front, 2.828427).value == Approx(14.14214));
  CHECK(error_at(front, 1).bound == Bound::at_least);
  CHECK(error_at(front, 9).bound == Bound::at_most);
  CHECK(cost_at(front, 10).value == 4);
  CHECK(cost_at(front, 14.14214).value == Approx(2.828427));
  CHECK(cost_at(front, 30).bound == Bound::at_most);
  CHECK(cost_at(front, 1).value == 8);
  CHECK(cost_at(front, 1).bound == Bound::at_least);
}

TEST_CASE("bands over seeds, thinned and smoothed") {
  Run a, b;
  a.curves["ate"] = {{0, 1, 2, 3}, {1, 1, 1, 1}};
  b.curves["ate"] = {{0, 1, 2}, {3, 5, 7}};
  const auto band = over_seeds({&a, &b}, "ate");
  CHECK(band.mid == std::vector<double>{2, 3, 4, 1});
  CHECK(band.high == std::vector<double>{3, 5, 7, 1});
  const auto thin = thinned(band, 2);
  CHECK(thin.x == std::vector<double>{0.5, 2.5});
  CHECK(thin.low == std::vector<double>{1, 1});
  CHECK(thin.high == std::vector<double>{5, 7});
  CHECK(running_median({1, 9, 2, 3, 8}, 3) == std::vector<double>{1, 2, 3, 3, 8});
}

TEST_CASE("graphs are compared value by value and line by line") {
  const auto left = graph_values(
      "name: a\nnodes:\n  - {name: init, module: map.x, when: {until_frame: 0}, params: {size: 2 cm, list: [1, 2]}}\n",
      "left");
  const auto right = graph_values(
      "name: b\nnodes:\n  - {name: init, module: map.y, when: {until_frame: 0}, params: {size: 2 cm, more: 1}}\n",
      "right");
  const auto changes = value_changes(left, right);
  REQUIRE(changes.size() == 3);
  CHECK(changes[0].key == "init.module");
  CHECK(changes[1].left == "[1, 2]");
  CHECK(changes[1].right.empty());
  CHECK(changes[2].key == "init.more");
  std::string marks;
  for (const auto& line : line_diff("a\nb\nc\n", "a\nx\nc\nd\n")) marks += line.mark;
  CHECK(marks == " -+ +");
}

TEST_CASE("text for HTML, bytes as base64") {
  CHECK(escaped("<a href=\"x\">&'") == "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("foob") == "Zm9vYg==");
  CHECK(base64("foobar") == "Zm9vYmFy");
}
