#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <thread>

#include "tests/apps/command.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

/// Until a run is well among its frames.
void wait_for_frames() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  std::this_thread::sleep_for(std::chrono::seconds(10));
#else
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
#endif
}

}  // namespace

TEST_CASE("a run leaves its folder complete and says where it is") {
  SmallRoom room;
  const auto run = room.run();
  INFO(run->err);
  REQUIRE(run->code == 0);
  CHECK_THAT(run->out, Contains("results in " + room.out.string()) && Contains("ATE") && Contains("coverage"));

  const auto json = read_json(room.out / "run.json");
  CHECK(json["graph"] == "small");
  CHECK(json["seed"] == 3);
  CHECK(json["frames"] == 10);  // 12 less the held-out images 2 and 7
  CHECK(json["last_index"] == 11);
  CHECK(json["interrupted"] == false);
  CHECK(json["particles"] == 6);
  CHECK(json["wall_s"].get<double>() > 0);
  CHECK(json["fps"].get<double>() == Approx(10 / json["wall_s"].get<double>()));
  CHECK(json["ess_mean"].get<double>() >= 1);
  CHECK(json["ess_mean"].get<double>() <= 6);
  CHECK(json["nodes"]["look"]["runs"] == 10);
  CHECK(json["nodes"]["motion"]["runs"] == 9);
  for (const char* key : {"ms_mean", "ms_p50", "ms_p99"}) CHECK(json["nodes"]["update"][key].get<double>() > 0);
  for (const char* key : {"chunks", "vertices", "faces", "texels", "bytes", "bytes_owned_total"})
    CHECK(json["map"][key].get<std::int64_t>() > 0);
  CHECK(json["map"]["bytes_shared_total"].get<std::int64_t>() >= 0);
  CHECK(json["trajectory"]["pairs"] == 10);
  CHECK(json["trajectory"]["ate_rmse_m"].get<double>() < 0.1);
  CHECK(json["holdout"]["frames"] == 2);
  CHECK(json["holdout"]["poses"] == "reference, aligned");
  CHECK(json["holdout_estimated"]["poses"] == "estimated, between neighbours");
  for (const char* holdout : {"holdout", "holdout_estimated"}) {
    CHECK(json[holdout]["coverage"].get<double>() > 0.5);
    CHECK(json[holdout]["median_mm"].get<double>() < 60);
  }
  const auto& surface = json["surface"];
  CHECK(surface["samples"] == 100000);
  CHECK(surface["seen_points"].get<int>() > 5000);
  CHECK(surface["accuracy_median_mm"].get<double>() < 30);
  CHECK(surface["completeness_median_mm"].get<double>() < 30);
  CHECK(surface["recall_2cm"] == surface["completeness_within_2cm"]);
  CHECK(surface["f_score_2cm"].get<double>() > 0.4);
  CHECK(json["digest"].get<std::string>().size() == 32);
  CHECK(json["trajectory_online"]["estimate"] == "best");
  CHECK(json["trajectory_online"]["pairs"] == 10);
  CHECK(json["belief"]["spread_m"].get<double>() > 0);
  const auto& ancestry = json["belief"]["ancestry"];
  CHECK(ancestry["depth"] == 10);
  CHECK(ancestry["nodes"].get<int>() >= 10);
  CHECK(ancestry["nodes"].get<int>() <= 60);
  CHECK(ancestry["coalescence_frames"].get<int>() <= 10);
  const auto& tracking = json["tracking"];
  CHECK(tracking["judge"].is_null());
  CHECK_FALSE(tracking.contains("lost_frames"));  // nobody said
  CHECK(tracking["ess_min"].get<double>() >= 1);
  CHECK(tracking["degenerate_frames"] == 0);
  CHECK(tracking["miss_weight_mean"].get<double>() < 0.2);
  CHECK(tracking["innovation_variance"].get<double>() < 3);
  CHECK_FALSE(json.contains("revisits"));  // twelve images

  CHECK(half_written(room.out).empty());
  std::vector<std::string> files = json["files"];
  CHECK(files == std::vector<std::string>{"config.effective.yaml", "holdout.csv", "map.ppm", "metrics.csv", "trajectory.tum",
                                          "trajectory_error.csv", "trajectory_online.tum"});
  for (const auto& f : files) CHECK(std::filesystem::file_size(room.out / f) > 0);
}

TEST_CASE("a run leaves its errors frame by frame, of the same pixels and the same alignment as the totals") {
  SmallRoom room;
  REQUIRE(room.run()->code == 0);
  const auto json = read_json(room.out / "run.json");

  const auto path = lines(content(room.out / "trajectory_error.csv"));
  REQUIRE(path.size() == 11);
  CHECK(path[0] == "frame,stamp_s,error_m,online_error_m");
  double squares = 0, online_squares = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    int frame = -1;
    double stamp = 0, error = -1, online = -1;
    REQUIRE(std::sscanf(path[i].c_str(), "%d,%lf,%lf,%lf", &frame, &stamp, &error, &online) == 4);
    CHECK(frame % 5 != 2);  // held out
    squares += error * error;
    online_squares += online * online;
  }
  CHECK(std::sqrt(squares / 10) == Approx(json["trajectory"]["ate_rmse_m"].get<double>()).margin(1e-6));
  CHECK(std::sqrt(online_squares / 10) == Approx(json["trajectory_online"]["ate_rmse_m"].get<double>()).margin(1e-6));

  const auto holdout = lines(content(room.out / "holdout.csv"));
  REQUIRE(holdout.size() == 5);
  CHECK(holdout[0] == "poses,frame,pixels,coverage,median_mm,mean_trunc20cm_mm,log_density");
  double pixels = 0, covered = 0;
  for (const auto& line : holdout) {
    if (line.rfind("reference,", 0) != 0) continue;
    double frame = -1, n = 0, coverage = 0;
    REQUIRE(std::sscanf(line.c_str(), "reference,%lf,%lf,%lf", &frame, &n, &coverage) == 3);
    CHECK((frame == 2 || frame == 7));
    pixels += n;
    covered += n * coverage;
  }
  CHECK_THAT(holdout[4], Catch::StartsWith("estimated,7,"));
  CHECK(pixels == json["holdout"]["pixels"].get<double>());
  CHECK(covered / pixels == Approx(json["holdout"]["coverage"].get<double>()).margin(1e-5));
  const auto& calibration = json["holdout"]["calibration"];
  CHECK(calibration["nominal"].size() == 20);
  CHECK(calibration["measured"].size() == 20);
  CHECK(calibration["measured"][19].get<double>() > 0.5);
  CHECK(json["holdout"]["crps_mm"].get<double>() > 1);
  CHECK(json["holdout"]["crps_mm"].get<double>() < 60);
}

TEST_CASE("a run that is lost says so, in run.json and on the terminal") {
  SmallRoom room;
  auto run_with = [&](const std::string& params) {
    std::string text = kSmallRoom;
    text.insert(text.find("  - {name: pick"),
                "  - {name: find, module: recovery.relocalize, in: {frame: camera.frame, view: look}, when: {from_frame: 1}, "
                "params: " + params + "}\n"
                "  - {name: again, module: prediction.embree, in: {frame: camera.frame}, when: {from_frame: 1}}\n");
    write_text(room.graph, text);
    auto run = room.run();
    INFO(run->err);
    REQUIRE(run->code == 0);
    return run;
  };
  const auto sound = run_with("{lost_outliers: 0.9, lost_inliers: 0}");
  CHECK_THAT(sound->out, Contains("never lost"));
  auto tracking = read_json(room.out / "run.json")["tracking"];
  CHECK(tracking["judge"] == "find");
  CHECK(tracking["lost_frames"] == 0);
  CHECK(tracking["first_lost"].is_null());
  CHECK(tracking["lost_at_end"] == false);

  // Nothing is good enough: lost after a few frames, and to the end.
  write_text(room.folder / "seen.tum", "0 0 0 0 0 0 0 1\n");
  const auto lost = run_with("{lost_outliers: 0, found_outliers: 0, lost_inliers: 0.999, found_inliers: 1, patience: 2, path: " +
                             (room.folder / "seen.tum").string() + "}");
  CHECK_THAT(lost->out, Contains("LOST") && Contains("STILL LOST at the end") && !Contains("never lost"));
  tracking = read_json(room.out / "run.json")["tracking"];
  CHECK(tracking["lost_frames"].get<int>() >= 7);
  CHECK(tracking["longest_lost"] == tracking["lost_frames"]);
  CHECK(tracking["first_lost"].get<int>() <= 4);
  CHECK(tracking["lost_at_end"] == true);
  CHECK(tracking["unexplained_frames"].get<int>() > 0);
}

TEST_CASE("the same bytes for 1, 2 and 4 threads, and from the effective configuration, others for another seed") {
  SmallRoom room;
  auto digest = [&](std::vector<std::string> more) {
    const auto run = room.run(std::move(more));
    INFO(run->err);
    REQUIRE(run->code == 0);
    return read_json(room.out / "run.json")["digest"].get<std::string>();
  };
  const auto one = digest({"--threads", "1"});
  CHECK(digest({"--threads", "2"}) == one);
  CHECK(digest({"--threads", "4"}) == one);
  CHECK(digest({"--seed", "4"}) != one);
  CHECK(digest({"--set", "motion.sigma_t=5 mm"}) != one);

  REQUIRE(room.run()->code == 0);
  const auto again =
      ppm_command({"run", (room.out / "config.effective.yaml").string(), "--out", (room.folder / "again").string()});
  INFO(again->err);
  REQUIRE(again->code == 0);
  CHECK(read_json(room.folder / "again/run.json")["digest"] == one);
  CHECK(content(room.folder / "again/config.effective.yaml") == content(room.out / "config.effective.yaml"));
}

TEST_CASE("option --frames ends early, --quiet is quiet, and only frames up to the last mapped one are scored") {
  SmallRoom room;
  const auto run = room.run({"--frames", "5", "--quiet"});
  REQUIRE(run->code == 0);
  CHECK(run->out.empty());
  CHECK(run->err.empty());
  const auto json = read_json(room.out / "run.json");
  CHECK(json["frames"] == 5);
  CHECK(json["last_index"] == 5);
  CHECK(json["holdout"]["frames"] == 1);
}

TEST_CASE("option --times keeps time and memory by frame") {
  SmallRoom room;
  const auto run = room.run({"--frames", "3", "--times"});
  INFO(run->err);
  REQUIRE(run->code == 0);
  const auto times = lines(content(room.out / "times.csv"));
  REQUIRE(times.size() == 4);
  CHECK(times[0] == "frame,wall_ms,cpu_ms,resident_mb,heap_mb");
  for (int i = 1; i <= 3; ++i) {
    int frame = -1;
    double wall = 0, cpu = 0, resident = 0, heap = 0;
    const int found = std::sscanf(times[static_cast<std::size_t>(i)].c_str(), "%d,%lf,%lf,%lf,%lf", &frame, &wall, &cpu,
                                  &resident, &heap);
    CHECK(found == 5);
    CHECK(frame == i - 1);
    CHECK(wall > 0);
    CHECK(resident > 1);
  }
  CHECK(read_json(room.out / "run.json")["files"].dump().find("times.csv") != std::string::npos);
}

TEST_CASE("option --views draws held-out frames, the same ones for every map") {
  SmallRoom room;
  const auto run = room.run({"--views", "2"});
  INFO(run->err);
  REQUIRE(run->code == 0);
  const auto views = read_json(room.out / "views/views.json");
  REQUIRE(views.size() == 2);
  CHECK(views[0]["frame"] == 2);
  CHECK(views[1]["frame"] == 7);
  CHECK(views[1]["measured"] == "view_1_7_measured.png");
  CHECK(views[1]["poses"] == "reference, aligned");
  for (const auto& view : views)
    for (const char* what : {"measured", "predicted", "error"})
      CHECK(std::filesystem::file_size(room.out / "views" / view[what].get<std::string>()) > 1000);
  const std::vector<std::string> files = read_json(room.out / "run.json")["files"];
  CHECK(std::ranges::count(files, "views/view_0_2_error.png") == 1);

  // The next run leaves none of the pictures behind.
  REQUIRE(room.run({"--frames", "4"})->code == 0);
  CHECK_FALSE(std::filesystem::exists(room.out / "views"));
}

TEST_CASE("one frame is a run too: nothing to compare a path with") {
  SmallRoom room;
  const auto run = room.run({"--frames", "1"});
  INFO(run->err);
  REQUIRE(run->code == 0);
  CHECK_FALSE(read_json(room.out / "run.json").contains("trajectory"));
}

TEST_CASE("with known poses the held-out frames are looked at from the reference itself") {
  SmallRoom room;
  auto text = content(room.graph);
  text.replace(text.find("motion.constant_velocity"), 24, "motion.reference_pose");
  const auto sigma = text.find(", params: {sigma_t: 4 mm, sigma_r: 0.3 deg}");
  text.erase(sigma, text.find('}', sigma) - sigma + 1);
  write_text(room.graph, text);
  const auto run = room.run();
  INFO(run->err);
  REQUIRE(run->code == 0);
  const auto json = read_json(room.out / "run.json");
  CHECK(json["holdout"]["poses"] == "reference");
  CHECK_FALSE(json.contains("holdout_estimated"));  // it would be the same
  CHECK(json["trajectory"]["ate_rmse_m"].get<double>() < 1e-9);
}

TEST_CASE("Ctrl-C ends the frame, writes everything, says so, the exit code is 1") {
  SmallRoom room;
  auto run = start_ppm(
      {"run", room.graph, "--out", room.out.string(), "--set", "camera.frames=100000", "--set", "camera.holdout=none"});
  wait_for_frames();
  run->send(SIGINT);
  run->wait();
  INFO(run->err);
  CHECK(run->code == 1);
  CHECK_THAT(run->err, Contains("interrupted: finishing this frame"));
  CHECK_THAT(run->out, Contains("interrupted after") && Contains("results in"));
  const auto json = read_json(room.out / "run.json");
  CHECK(json["interrupted"] == true);
  CHECK(json["frames"].get<int>() > 0);
  CHECK(half_written(room.out).empty());
  CHECK(lines(content(room.out / "trajectory.tum")).size() == json["frames"].get<std::size_t>());
  CHECK(std::filesystem::exists(room.out / "map.ppm"));
}

TEST_CASE("a second Ctrl-C aborts: no result is left under its name") {
  SmallRoom room;
  auto run = start_ppm({"run", room.graph, "--out", room.out.string(), "--set", "camera.frames=100000", "--set",
                        "camera.pixel_stride=1", "--set", "init.particles=400", "--set", "camera.holdout=none"});
  wait_for_frames();
  run->send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  run->send(SIGINT);
  run->wait();
  CHECK(run->code == -1);
  CHECK(run->signal == SIGINT);
  CHECK_FALSE(std::filesystem::exists(room.out / "run.json"));
}
