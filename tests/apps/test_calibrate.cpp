#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/apps/command.hpp"
#include "tests/support/data.hpp"

using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

const char* const kRoomSource = R"(name: room
seed: 3
nodes:
  - {name: camera, module: source.synthetic_room, params: {frames: 7}}
)";

}  // namespace

TEST_CASE("calibrate sensor says what the images are not") {
  TempFolder folder;
  const auto graph = (folder / "room.yaml").string();
  write_text(graph, kRoomSource);
  const auto odd = ppm_command({"calibrate", "sensor", graph, "--still", "2"});
  CHECK(odd->code == 2);
  CHECK_THAT(odd->err, Contains("room.yaml") && Contains("7 images") && Contains("--still"));
  CHECK(ppm_command({"calibrate", "sensor", graph, "--still", "1"})->code == 2);
  CHECK(ppm_command({"calibrate"})->code == 2);
}

TEST_CASE("calibrate sensor fits the SR4000's noise, and every place as well by the others") {
  const auto data = data_path("sr4000");
  if (!data) return;
  TempFolder folder;
  const auto bins = folder / "bins.csv";
  const auto run =
      ppm_command({"calibrate", "sensor", std::string(PPM_SOURCE_DIR) + "/configs/sr4000_still.yaml", "--set",
                   "camera.path=" + data->string(), "--set", "camera.last=-1", "--bins", bins.string()});
  INFO(run->err);
  REQUIRE(run->code == 0);
  const auto out = lines(run->out);
  double floor = 0, signal = 0;
  int shares = 0;
  for (const auto& line : out) {
    std::sscanf(line.c_str(), "  sigma_floor: %lf m", &floor);
    std::sscanf(line.c_str(), "  signal_noise: %lf", &signal);
    double one = 0, two = 0;
    const auto at = line.find(" 0.");
    if (line.starts_with("#   ") && at != std::string::npos &&
        std::sscanf(line.c_str() + at, "%lf %lf", &one, &two) == 2) {
      ++shares;
      CHECK(one == Approx(0.683).margin(0.06));
      CHECK(two == Approx(0.954).margin(0.04));
    }
  }
  CHECK(shares == 5);
  CHECK(floor == Approx(0.013).margin(0.003));
  CHECK(signal == Approx(3.2).margin(0.4));
  CHECK(lines(content(bins)).size() > 30);
}

TEST_CASE("calibrate motion says how far each model misses the reference, and what to write into a graph") {
  TempFolder folder;
  const auto graph = (folder / "room.yaml").string();
  write_text(graph, kRoomSource);
  const auto few = ppm_command({"calibrate", "motion", graph});
  CHECK(few->code == 2);
  CHECK_THAT(few->err, Contains("7 reference poses are too few"));
  const auto longer = std::vector<std::string>{"calibrate", "motion", graph, "--set", "camera.frames=60"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), longer.begin(), longer.end());
    return ppm_command(more);
  };
  const auto all = with({"--every", "1,3"});
  INFO(all->err);
  REQUIRE(all->code == 0);
  CHECK_THAT(all->out, Contains("motion.constant_velocity:") && Contains("motion.random_walk:") &&
                           Contains("# motion.imu: the source has no inertial samples") &&
                           Contains("# motion.odometry: the source has no odometry") && Contains("  sigma_t: "));
  const auto one = with({"--model", "motion.random_walk", "--every", "1,2", "--json"});
  REQUIRE(one->code == 0);
  const auto json = nlohmann::json::parse(one->out);
  REQUIRE(json["motion.random_walk"].size() == 2);
  CHECK(json["motion.random_walk"][0]["steps"] == 57);
  CHECK(json["motion.random_walk"][1]["sigma_t_m"] > 1.5 * json["motion.random_walk"][0]["sigma_t_m"].get<double>());
  CHECK(json["motion.random_walk"][0].contains("consistency_learnt"));
  const auto blind = with({"--model", "motion.imu"});
  CHECK(blind->code == 2);
  CHECK_THAT(blind->err, Contains("frame 0") && Contains("without inertial samples"));
  const auto wrong = with({"--model", "motion.reference_pose"});
  CHECK(wrong->code == 2);
  CHECK_THAT(wrong->err, Contains("no motion model"));
}

TEST_CASE("calibrate camera finds what was falsified in the simulated room") {
  const auto run = ppm_command({"calibrate", "camera", std::string(PPM_SOURCE_DIR) + "/configs/room.yaml", "--set",
                                "camera.focal_scale=0.97", "--set", "camera.depth_bend=0.02", "--frames", "30", "--step", "4"});
  INFO(run->err);
  REQUIRE(run->code == 0);
  double focal = 0, bend = 1, sigma = 0;
  for (const auto& line : lines(run->out)) {
    std::sscanf(line.c_str(), "focal_scale: %lf # +- %lf", &focal, &sigma);
    std::sscanf(line.c_str(), "depth_bend: %lf", &bend);
  }
  CHECK(focal == Approx(1).margin(0.004));
  CHECK(bend == Approx(0).margin(0.005));
  CHECK(sigma < 0.003);
}

TEST_CASE("calibrate camera says why a camera cannot be found") {
  TempFolder folder;
  const auto graph = (folder / "room.yaml").string();
  write_text(graph, kRoomSource);
  const auto few = ppm_command({"calibrate", "camera", graph});
  CHECK(few->code == 2);
  CHECK_THAT(few->err, Contains("7 of 7 frames have a pose") && Contains("8"));
  const auto still = ppm_command({"calibrate", "camera", graph, "--set", "camera.frames=9"});
  CHECK(still->code == 2);
  CHECK_THAT(still->err, Contains("focal length cannot be seen"));
  const auto apart = ppm_command({"calibrate", "camera", graph, "--set", "camera.frames=380", "--frames", "9"});
  CHECK(apart->code == 2);
  CHECK_THAT(apart->err, Contains("too little overlap"));
}

TEST_CASE("calibrate noise fits the noise of a run's source to its held-out frames") {
  TempFolder folder;
  const auto out = (folder / "run").string();
  REQUIRE(ppm_command({"run", std::string(PPM_SOURCE_DIR) + "/configs/room_mapping.yaml", "--frames", "60", "--out", out})->code == 0);
  const auto run = ppm_command({"calibrate", "noise", out});
  INFO(run->err);
  REQUIRE(run->code == 0);
  double before = 0, after = 0, one = 0, floor = 0, lateral = 0;
  for (const auto& line : lines(run->out)) {
    std::sscanf(line.c_str(), "sigma_floor: %lf m", &floor);
    std::sscanf(line.c_str(), "sigma_lateral: %lf px", &lateral);
    std::sscanf(line.c_str(), "#   the run's noise model %lf", &before);
    std::sscanf(line.c_str(), "#   this fit %lf %lf", &after, &one);
  }
  CHECK(floor > 0.001);
  CHECK(floor < 0.01);
  CHECK(lateral > 0);
  CHECK(after > before - 0.1);  // the room gives the true sigma of each pixel; the model knows the depth alone
  CHECK(one == Approx(0.683).margin(0.08));
  CHECK(ppm_command({"calibrate", "noise", (folder / "none").string()})->code == 2);
}
