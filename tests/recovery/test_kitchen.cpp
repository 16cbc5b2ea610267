#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/recovery/carried_camera.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using ppm::test::CarriedRun;

namespace {

/// A folder of links to images of the kitchen, numbered anew.
void link_images(const std::filesystem::path& kitchen, const std::filesystem::path& folder, const std::vector<int>& images) {
  std::filesystem::create_symlink(std::filesystem::absolute(kitchen / "camera-intrinsics.txt"), folder / "camera-intrinsics.txt");
  for (std::size_t n = 0; n < images.size(); ++n)
    for (const char* kind : {"depth.png", "color.jpg", "pose.txt"})
      std::filesystem::create_symlink(std::filesystem::absolute(kitchen / fmt::format("frame-{:06d}.{}", images[n], kind)),
                                      folder / fmt::format("frame-{:06d}.{}", n, kind));
}

}  // namespace

TEST_CASE("a Kinect that is carried across the kitchen is lost, found, and right again") {
  const auto data = test::data_path("kitchen");
  if (!data) return;
  const test::TempFolder folder;
  std::vector<int> images;
  for (int i = 100; i <= 430; i += 3) images.push_back(i);
  const auto carried = static_cast<std::int64_t>(images.size());
  for (int i = 121; i <= 160; i += 3) images.push_back(i);  // 1.7 m and 45 degrees away
  link_images(*data, folder.path(), images);
  CarriedRun run(R"(
name: kitchen
seed: 3
nodes:
  - {name: camera, module: source.seven_scenes, params: {path: ")" + folder.path().string() + R"(", pixel_stride: 2}}
  - {name: init,   module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}, params: {particles: 2}}
  - {name: motion, module: motion.constant_velocity, in: {frame: camera.frame}, when: {from_frame: 1},
     params: {sigma_t: 2 cm, sigma_r: 1 deg}}
  - {name: align,  module: motion.aligned, in: {frame: camera.frame, view: look}, when: {from_frame: 1}}
  - {name: look,   module: prediction.raster, in: {frame: camera.frame}, when: {from_frame: 1}, params: {stride: 4}}
  - {name: weigh,  module: weighting.robust, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: recover, module: recovery.relocalize, in: {frame: camera.frame, view: look}, when: {from_frame: 1}}
  - {name: pick,   module: resampling.systematic, when: {from_frame: 1}, params: {number: fixed, particles: 2}}
  - {name: view,   module: prediction.raster, in: {frame: camera.frame}}
  - {name: update, module: map_update.ppm_bayes, in: {frame: camera.frame}}
)");
  run.run_to(carried);
  const auto lost = [&] {
    double frames = 0;
    for (double l : run.metric("recover.lost")) frames += l;
    return frames;
  };
  CHECK(lost() == 0);
  run.run_to(carried + 3);
  CHECK(run.belief().lost);
  run.run_to(1000);
  CHECK_FALSE(run.belief().lost);
  CHECK(lost() <= 8);
  const auto path = run.belief().trajectory[run.belief().best()].poses();
  const std::size_t earlier = (160 - 100) / 3;  // the same image, in the first stretch
  CHECK((path.back().T_map_camera.translation() - path[earlier].T_map_camera.translation()).norm() < 0.1);
}
