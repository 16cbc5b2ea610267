#include <catch2/catch.hpp>
#include <numbers>

#include "framework/graph/harness.hpp"
#include "framework/slam/frame.hpp"
#include "modules/maps/ppm/ppm_file.hpp"
#include "tests/support/ppm_maps.hpp"
#include "tests/support/registry.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using Catch::Matchers::Contains;

namespace {

std::shared_ptr<const Frame> first_frame(std::optional<Pose> reference = {}) {
  auto frame = std::make_shared<Frame>();
  frame->index = 42;
  frame->stamp_s = 1.5;
  frame->T_world_camera_ref = reference;
  return frame;
}

Pose some_pose() {
  return se3_exp((Twist() << 1, -2, 3, 0.3, 0.2, -0.1).finished());
}

/// A folder with a saved map.
struct Saved {
  test::TempFolder folder;
  std::shared_ptr<const PpmMap> map = test::height_field(4, 3, 0.1f);
  Saved() { save_ppm(*map, folder / "map.ppm"); }
  std::unique_ptr<Harness> start(const std::string& params, std::optional<Pose> reference = {}, bool whole_folder = false) const {
    const auto path = (whole_folder ? folder.path() : folder / "map.ppm").string();
    auto h = std::make_unique<Harness>(test::builtin(), "map.ppm_file", "{path: \"" + path + "\", " + params + "}");
    h->input<Frame>("frame", first_frame(reference));
    return h;
  }
};

}  // namespace

TEST_CASE("map.ppm_file starts all particles on the saved map, from the file or from the folder of its run") {
  const Saved saved;
  for (bool folder : {false, true}) {
    auto h = saved.start("particles: 5, start: identity", {}, folder);
    h->tick();
    const auto& belief = h->belief();
    REQUIRE(belief.size() == 5);
    CHECK(test::digest_of(*belief.map[0]) == test::digest_of(*saved.map));
    CHECK(belief.ess() == Approx(5));
    for (std::size_t i = 0; i < 5; ++i) {
      CHECK(belief.map[i] == belief.map[0]);
      CHECK(belief.pose[i].matrix() == Eigen::Matrix4d::Identity());
      CHECK(belief.trajectory[i].last().frame == 42);
      CHECK(belief.trajectory[i].last().stamp_s == 1.5);
    }
    CHECK_FALSE(belief.T_map_world);
  }
}

TEST_CASE("map.ppm_file starts at the reference or at a given pose, and tells where the reference lies") {
  const Saved saved;
  auto at_reference = saved.start("particles: 2", some_pose());
  at_reference->tick();
  CHECK(at_reference->belief().pose[1].matrix() == some_pose().matrix());
  CHECK(at_reference->belief().T_map_world->matrix() == Eigen::Matrix4d::Identity());

  auto at_pose = saved.start("particles: 2, start: pose, pose: \"0.5 1 -2 0 0 0.6 0.8\"", some_pose());
  at_pose->tick();
  const Pose& pose = at_pose->belief().pose[0];
  CHECK(pose.translation() == Eigen::Vector3d(0.5, 1, -2));
  CHECK(Eigen::Quaterniond(pose.linear()).isApprox(Eigen::Quaterniond(0.8, 0, 0, 0.6)));
  CHECK((*at_pose->belief().T_map_world * some_pose()).isApprox(pose));
}

TEST_CASE("map.ppm_file can start lost: nobody knows where the reference lies") {
  const Saved saved;
  auto unknown = saved.start("particles: 2, start: unknown", some_pose());
  unknown->tick();
  CHECK(unknown->belief().lost);
  CHECK_FALSE(unknown->belief().T_map_world);
  CHECK(unknown->belief().trajectory[1].last().T_map_camera.matrix() == Eigen::Matrix4d::Identity());
  auto known = saved.start("particles: 2", some_pose());
  known->tick();
  CHECK_FALSE(known->belief().lost);
}

TEST_CASE("map.ppm_file spreads the first poses, the same for the same seed") {
  const Saved saved;
  auto spread = [&] {
    auto h = saved.start("particles: 4000, start: identity, sigma_t: 10 cm, sigma_r: 2 deg");
    h->tick();
    return h->belief().pose;
  };
  const auto poses = spread();
  double t2 = 0, r2 = 0;
  for (const auto& pose : poses) {
    const Twist xi = se3_log(pose);
    t2 += xi.head<3>().squaredNorm() / (3.0 * 4000);
    r2 += xi.tail<3>().squaredNorm() / (3.0 * 4000);
  }
  CHECK(std::sqrt(t2) == Approx(0.1).epsilon(0.05));
  CHECK(std::sqrt(r2) == Approx(2 * std::numbers::pi / 180).epsilon(0.05));
  CHECK(poses[17].matrix() == spread()[17].matrix());
}

TEST_CASE("map.ppm_file says what is wrong with its parameters and its file") {
  const Saved saved;
  CHECK_THROWS_WITH(saved.start("pose: \"1 2 3\", start: pose"), Contains("has 3 numbers, not the 7 of 'tx ty tz qx qy qz qw'"));
  CHECK_THROWS_WITH(saved.start("pose: \"0 0 0 0 0 0 2\", start: pose"), Contains("the quaternion has norm 2"));
  CHECK_THROWS_WITH(saved.start("start: pose")->tick(), Contains("needs the parameter 'pose'"));
  CHECK_THROWS_WITH(saved.start("pose: \"0 0 0 0 0 0 1\"")->tick(), Contains("is not `start: pose`"));
  CHECK_THROWS_WITH(saved.start("start: reference")->tick(), Contains("frame 42") && Contains("no reference pose to start at"));
  CHECK_THROWS_WITH(Harness(test::builtin(), "map.ppm_file", "{}"), Contains("path"));
  Harness none(test::builtin(), "map.ppm_file", "{path: no/such/map.ppm}");
  none.input<Frame>("frame", first_frame());
  CHECK_THROWS_WITH(none.tick(), Contains("no/such/map.ppm") && Contains("cannot be opened"));
}
