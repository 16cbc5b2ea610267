#include <catch2/catch.hpp>
#include <set>

#include "tests/apps/command.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;

TEST_CASE("bench --quick times every group, compares back-ends and writes JSON") {
  TempFolder folder;
  const auto file = folder / "bench.json";
  const auto run = ppm_command({"bench", "--quick", "--threads", "2", "--json", file.string()});
  INFO(run->err);
  REQUIRE(run->code == 0);
  CHECK_THAT(run->out, Contains("GFLOP/s") && Contains("GB/s"));
  const auto json = read_json(file);
  CHECK(json["threads"] == 2);
  CHECK(json["quick"] == true);
  std::set<std::string> groups;
  for (const auto& c : json["cases"]) {
    INFO(c.dump());
    groups.insert(c["group"].get<std::string>());
    CHECK_THAT(run->out, Contains(c["name"].get<std::string>()));
    if (c.contains("left_out")) continue;  // a back-end that this machine cannot run
    CHECK(c["ms"].get<double>() > 0);
    CHECK(c["ms_best"].get<double>() <= c["ms"].get<double>());
  }
  CHECK(groups ==
        std::set<std::string>{"roof", "view", "view_filled", "weigh", "update", "frame", "gather", "simplify"});
  REQUIRE_FALSE(json["ratios"].empty());
  for (const auto& ratio : json["ratios"]) {
    INFO(ratio.dump());
    const auto& times = ratio["times_as_fast"];
    CHECK(times[times.contains("prediction.embree") ? "prediction.embree" : "prediction.raster"] == 1.0);
    CHECK_THAT(run->out, Contains(ratio["work"].get<std::string>()));
  }
  CHECK(json["kernels"].size() == 3);
  for (const auto& kernel : json["kernels"]) {
    INFO(kernel.dump());
    CHECK(kernel["flops"].get<double>() > 0);
    CHECK(kernel["bytes"].get<double>() > 0);
  }
  CHECK(half_written(folder.path()).empty());
}

TEST_CASE("bench takes the benchmarks that the filter matches") {
  const auto all = ppm_command({"bench", "--list"}), some = ppm_command({"bench", "--list", "--filter", "^gather"});
  REQUIRE(all->code == 0);
  CHECK(lines(all->out).size() > 50);
  CHECK(lines(some->out) == std::vector<std::string>{"gather/particles:100", "gather/particles:1000"});
  const auto run = ppm_command({"bench", "--quick", "--rounds", "3", "--filter", "^gather"});
  CHECK(run->code == 0);
  CHECK(lines(run->out).size() == 2);  // heading and case; nothing to compare
}

TEST_CASE("bench says what is wrong with its options") {
  const auto complaint = [](std::vector<std::string> options) {
    options.insert(options.begin(), {"bench", "--quick"});
    const auto run = ppm_command(std::move(options));
    CHECK(run->code == 2);
    CHECK(run->out.empty());
    return run->err;
  };
  CHECK_THAT(complaint({"--filter", "nothing like it"}), Contains("--filter nothing like it") && Contains("--list"));
  CHECK_THAT(complaint({"--filter", "(view"}), Contains("--filter (view") && Contains("no regular expression"));
  CHECK_THAT(complaint({"--rounds", "0"}), Contains("--rounds"));
  CHECK_THAT(complaint({"--threads", "-1"}), Contains("--threads"));
  CHECK_THAT(complaint({"--plugin", "no.so"}), Contains("no.so"));
}

TEST_CASE("bench that cannot write its JSON says so before it measures") {
  TempFolder folder;
  const auto run =
      ppm_command({"bench", "--quick", "--filter", "^gather", "--json", (folder / "no" / "b.json").string()});
  CHECK(run->code != 0);
  CHECK_THAT(run->err, Contains("b.json"));
}

TEST_CASE("bench refuses a texel size that is none, with its place") {
  for (const auto& [size, says] : {std::pair<std::string, std::string>{"0 cm", "1 mm"}, {"3 deg", "deg"}}) {
    const auto run = ppm_command({"bench", "--list", "--texel-size", size});
    CHECK(run->code == 2);
    CHECK_THAT(run->err, Contains("--texel-size " + size) && Contains(says));
  }
}
