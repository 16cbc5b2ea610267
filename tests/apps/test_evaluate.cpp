#include <catch2/catch.hpp>
#include <fmt/core.h>

#include "tests/apps/command.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;

TEST_CASE("evaluate trajectory: a path against itself turned, and against one with a known error") {
  TempFolder folder;
  std::string reference, turned, off;
  for (int i = 0; i < 10; ++i) {
    const double x = 0.1 * i, y = 0.01 * i * i;
    reference += fmt::format("{} {} {} 0 0 0 0 1\n", i, x, y);
    turned += fmt::format("{} {} {} 1 0 0 0.70710678118 0.70710678118\n", i, -y, x);  // a quarter turn about z, up 1 m
    off += fmt::format("{} {} {} {} 0 0 0 1\n", i, x, y, i % 2 ? 0.01 : -0.01);
  }
  write_text(folder / "ref.tum", reference);
  write_text(folder / "turned.tum", turned);
  write_text(folder / "off.tum", off);
  auto measure = [&](const char* file, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"evaluate", "trajectory", (folder / file).string(),
                                       (folder / "ref.tum").string(), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto run = ppm_command(std::move(arguments));
    INFO(run->err);
    REQUIRE(run->code == 0);
    return nlohmann::json::parse(run->out)["trajectory"];
  };
  CHECK(measure("turned.tum")["ate_rmse_m"].get<double>() < 1e-6);
  CHECK(measure("turned.tum")["pairs"] == 10);
  CHECK(measure("off.tum")["ate_rmse_m"].get<double>() == Approx(0.01).epsilon(0.05));
  CHECK(measure("off.tum")["rpe_trans_rmse_m"].get<double>() == Approx(0.02).epsilon(1e-6));
  CHECK(measure("off.tum", {"--delta", "2"})["rpe_trans_rmse_m"].get<double>() == Approx(0).margin(1e-9));

  const auto table =
      ppm_command({"evaluate", "trajectory", (folder / "off.tum").string(), (folder / "ref.tum").string()});
  CHECK_THAT(table->out, Contains("ATE 0.0") && Contains("(10 poses)"));
}

TEST_CASE("evaluate trajectory: files that are wrong") {
  TempFolder folder;
  write_text(folder / "ref.tum", "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
  write_text(folder / "bad.tum", "0 0 0 0 0 0 0 1\n1 0 0 zero 0 0 0 1\n");
  write_text(folder / "later.tum", "10 0 0 0 0 0 0 1\n11 0 0 0 0 0 0 1\n");
  auto complaint = [&](const char* file) {
    const auto run = ppm_command({"evaluate", "trajectory", (folder / file).string(), (folder / "ref.tum").string()});
    CHECK(run->code == 2);
    return run->err;
  };
  CHECK_THAT(complaint("bad.tum"), Contains("bad.tum:2:1") && Contains("'zero'"));
  CHECK_THAT(complaint("no.tum"), Contains("no.tum"));
  CHECK_THAT(complaint("later.tum"), Contains("0 of its 2 poses"));
}

TEST_CASE("evaluate map gives the numbers of the run again") {
  SmallRoom room;
  REQUIRE(room.run()->code == 0);
  const auto of_run = read_json(room.out / "run.json");
  auto evaluate = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"evaluate", "map", room.out.string(), "--holdout", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto run = ppm_command(std::move(arguments));
    INFO(run->err);
    REQUIRE(run->code == 0);
    return nlohmann::json::parse(run->out);
  };
  const auto again = evaluate({});
  for (const char* key :
       {"coverage", "median_mm", "within_1cm", "within_2cm", "within_5cm", "mean_trunc20cm_mm", "log_density", "outliers",
        "within_1_sigma", "within_2_sigma"})
    CHECK(again["holdout"][key].get<double>() == Approx(of_run["holdout"][key].get<double>()).epsilon(1e-3));
  CHECK(again["holdout"]["pixels"] == of_run["holdout"]["pixels"]);
  CHECK(again["holdout"]["poses"] == "reference, aligned");
  CHECK(again["trajectory"]["ate_rmse_m"].get<double>() ==
        Approx(of_run["trajectory"]["ate_rmse_m"].get<double>()).epsilon(1e-5));
  CHECK(evaluate({"--threads", "1"}) == evaluate({"--threads", "4"}));
  const auto estimated = evaluate({"--poses", "estimated"}), reference = evaluate({"--poses", "reference"});
  CHECK_FALSE(estimated.contains("holdout"));
  CHECK(estimated["holdout_estimated"] == again["holdout_estimated"]);
  CHECK(reference["holdout"] == again["holdout"]);
  CHECK_FALSE(reference.contains("holdout_estimated"));
}

TEST_CASE("held-out frames that the filter follows are looked at from where it found them, and not mapped") {
  SmallRoom room;
  const auto run = room.run({"--set", "camera.held_out=followed"});
  INFO(run->err);
  REQUIRE(run->code == 0);
  const auto json = read_json(room.out / "run.json");
  CHECK(json["frames"] == 12);
  CHECK(json["trajectory"]["pairs"] == 12);
  CHECK(json["holdout"]["frames"] == 2);
  CHECK(json["holdout_estimated"]["frames"] == 2);
  CHECK(json["holdout_estimated"]["poses"] == "estimated");
  CHECK(json["holdout_estimated"]["median_mm"].get<double>() < 40);
  CHECK_THAT(run->out, Contains("poses: reference, aligned") && Contains("poses: estimated"));
  const auto again = ppm_command({"evaluate", "map", room.out.string(), "--holdout", "--json"});
  REQUIRE(again->code == 0);
  CHECK(nlohmann::json::parse(again->out)["holdout_estimated"]["median_mm"].get<double>() ==
        Approx(json["holdout_estimated"]["median_mm"].get<double>()).epsilon(1e-3));
}

TEST_CASE("evaluate revisits: images of one place against each other, with the run's poses and the reference's") {
  SmallRoom room;
  REQUIRE(room.run()->code == 0);
  auto evaluate = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"evaluate", "revisits", room.out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return ppm_command(std::move(arguments));
  };
  auto measure = [&](std::vector<std::string> more) {
    more.push_back("--json");
    const auto run = evaluate(more);
    INFO(run->err);
    REQUIRE(run->code == 0);
    return nlohmann::json::parse(run->out)["revisits"];
  };
  const auto run = measure({"--gap", "4"}), reference = measure({"--gap", "4", "--reference"});
  CHECK(run["gap"] == 4);
  CHECK(run["gap_is_exact"] == true);
  CHECK(run["pairs"] == reference["pairs"]);
  CHECK(reference["median_mm"].get<double>() < run["median_mm"].get<double>() + 5);
  CHECK(reference["median_mm"].get<double>() < 30);
  CHECK(measure({"--least", "4"})["pairs"].get<int>() > run["pairs"].get<int>());
  CHECK(measure({"--least", "4", "--pairs", "3"})["pairs"] == 3);
  CHECK(measure({"--least", "4", "--threads", "1"}) == measure({"--least", "4", "--threads", "4"}));
  CHECK_THAT(evaluate({"--least", "4"})->out, Contains("revisits") && Contains("4 and more apart"));

  const auto never = evaluate({});
  CHECK(never->code == 2);
  CHECK_THAT(never->err, Contains("at least 150"));
  CHECK(evaluate({"--least", "4", "--gap", "4"})->code == 2);
}

TEST_CASE("evaluate map: folders and files that are wrong") {
  SmallRoom room;
  auto complaint = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"evaluate", "map", room.out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto run = ppm_command(std::move(arguments));
    CHECK(run->code == 2);
    return run->err;
  };
  CHECK_THAT(complaint({"--holdout"}), Contains("config.effective.yaml: cannot read"));
  REQUIRE(room.run({"--frames", "3"})->code == 0);
  CHECK_THAT(complaint({}), Contains("--holdout"));
  CHECK_THAT(complaint({"--holdout", "--poses", "wishful"}), Contains("wishful"));
  const auto map = content(room.out / "map.ppm");
  write_text(room.out / "map.ppm", map.substr(0, map.size() / 2));
  CHECK_THAT(complaint({"--holdout"}), Contains("map.ppm"));
  std::filesystem::remove(room.out / "map.ppm");
  CHECK_THAT(complaint({"--holdout"}), Contains("map.ppm") && Contains("sink.map_ppm") && Contains("measured by the run itself"));
}
