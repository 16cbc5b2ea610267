#include <catch2/catch.hpp>
#include <fmt/core.h>

#include "modules/sources/pose_lookup.hpp"
#include "modules/sources/tum_sequence.hpp"
#include "tests/sources/image_writer.hpp"
#include "tests/sources/reprojection.hpp"
#include "tests/sources/source_reader.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr int kCols = 8, kRows = 6;

/// A folder with depth/I.png of constant depth 1 m + I cm and rgb/I.png of gray I, for I in 0 .. n-1; no lists.
class Folder {
 public:
  explicit Folder(int n) {
    std::filesystem::create_directories(folder / "depth");
    std::filesystem::create_directories(folder / "rgb");
    for (int i = 0; i < n; ++i) {
      const auto depth = static_cast<std::uint16_t>(5000 + 50 * i);
      write_gray16(folder / fmt::format("depth/{}.png", i), kCols, kRows,
                   std::vector<std::uint16_t>(kCols * kRows, depth));
      write_rgb(folder / fmt::format("rgb/{}.png", i), kCols, kRows,
                std::vector<std::uint8_t>(kCols * kRows * 3, static_cast<std::uint8_t>(i)));
    }
  }
  void list(const std::string& name, const std::string& text) const { write_bytes(folder / name, text); }
  std::string file(const std::string& name) const { return (folder / name).string(); }
  TumSettings settings() const {
    TumSettings s;
    s.path = folder.path();
    return s;
  }
  std::string error(const std::string& more = "") const {
    return data_error("source.tum_rgbd", fmt::format("{{path: \"{}\"{}}}", folder.path().string(), more));
  }

  TempFolder folder;
};

}  // namespace

TEST_CASE("associations.txt is read with the depth image first or second") {
  const Folder f(3);
  for (const std::string text : {"# pairs\n\n1 depth/1.png 1.01 rgb/2.png\n", "1.01 rgb/2.png 1 depth/1.png\n"}) {
    f.list("associations.txt", text);
    TumSettings settings = f.settings();
    settings.color = true;
    const TumSequence sequence(settings);
    REQUIRE(sequence.size() == 1);
    const Frame frame = sequence.read(0);
    CHECK(frame.stamp_s == 1);
    CHECK(frame.depth[0] == Approx(1.01));
    CHECK(frame.color[0] == 2);
    CHECK(frame.camera == Camera{kCols, kRows, 525, 525, 319.5, 239.5});
  }
}

TEST_CASE("without associations.txt the colour image nearest in time goes with a depth image") {
  const Folder f(4);
  f.list("depth.txt", "# depth maps\n1.00 depth/0.png\n1.10 depth/1.png\n1.20 depth/2.png\n");
  f.list("rgb.txt", "1.015 rgb/0.png\n1.105 rgb/1.png\n1.25 rgb/3.png\n");
  TumSettings settings = f.settings();
  settings.color = true;
  const TumSequence sequence(settings);
  REQUIRE(sequence.size() == 3);
  CHECK(sequence.read(0).color[0] == 0);
  CHECK(sequence.read(1).color[0] == 1);
  CHECK_THROWS_WITH(sequence.read(2), f.file("depth/2.png") + " (frame 2): no colour image within 0.02 s of it");
  CHECK(TumSequence(f.settings()).read(2).color.empty());
}

TEST_CASE("images without a reference pose are given without one, and counted") {
  const Folder f(3);
  f.list("depth.txt", "1 depth/0.png\n2 depth/1.png\n3 depth/2.png\n");
  CHECK(TumSequence(f.settings()).remarks() ==
        std::vector<std::string>{"there is no groundtruth.txt: the images have no reference pose"});
  f.list("groundtruth.txt",
         "# stamp tx ty tz qx qy qz qw\n1.99 0 0 1 0 0 0 1\n2.01 0 0 3 0 0 0 1\n3.015 7 0 0 0 0 0 1\n");
  const TumSequence sequence(f.settings());
  CHECK(sequence.remarks() == std::vector<std::string>{"1 of 3 images have no reference pose"});
  CHECK_FALSE(sequence.read(0).T_world_camera_ref);
  CHECK(sequence.read(1).T_world_camera_ref->translation().z() == Approx(2));  // between its two neighbours
  CHECK(sequence.read(2).T_world_camera_ref->translation().x() == Approx(7));  // the nearest one alone
}

TEST_CASE("a pose is looked up between the two around it") {
  std::vector<StampedPose> path(2);
  path[0].stamp_s = 1;
  path[1].stamp_s = 2;
  path[1].T_map_camera.translate(Eigen::Vector3d(4, 0, 0));
  CHECK(pose_at(path, 1.25, 1)->translation().x() == Approx(1));
  CHECK(pose_at(path, 1, 0)->translation().x() == 0);
  CHECK(pose_at(path, 2, 0)->translation().x() == 4);
  CHECK(pose_at(path, 1.25, 0.3)->translation().x() == 0);  // the other one is too far in time
  CHECK_FALSE(pose_at(path, 1.5, 0.3));
  CHECK_FALSE(pose_at(path, 2.5, 0.3));
  CHECK_FALSE(pose_at({}, 1, 10));
}

TEST_CASE("images listed beyond those that are there are left out, and said so") {
  const Folder f(6);
  for (int i : {0, 3}) std::filesystem::remove(f.folder / fmt::format("depth/{}.png", i));
  std::string text;
  for (int i = 0; i < 9; ++i) text += fmt::format("{0} depth/{0}.png {0} rgb/{0}.png\n", i);
  f.list("associations.txt", text);
  f.list("groundtruth.txt", "0 0 0 0 0 0 0 1\n10 0 0 0 0 0 0 1\n");
  TumSettings settings = f.settings();
  settings.max_dt_s = 10;
  const TumSequence sequence(settings);
  CHECK(sequence.size() == 5);
  CHECK(sequence.read(0).stamp_s == 1);
  CHECK(sequence.remarks() ==
        std::vector<std::string>{"associations.txt lists 9 images; only 1.png to 5.png are there"});
  CHECK_THROWS_WITH(sequence.read(2),
                    f.file("depth/3.png") + " (frame 2): cannot be opened: No such file or directory");
}

TEST_CASE("a folder that cannot be used names the file and the line") {
  const Folder f(2);
  CHECK(f.error() == f.folder.path().string() + ": has neither associations.txt nor depth.txt");
  const auto with = [&](const std::string& name, const std::string& text) {
    f.list(name, text);
    const std::string error = f.error();
    std::filesystem::remove(f.folder / name);
    return error;
  };
  CHECK(with("depth.txt", "") == f.file("depth.txt") + ": lists no images");
  CHECK(with("depth.txt", "1 depth/8.png\n") == f.file("depth.txt") + ": none of the images that it lists is there");
  CHECK(with("depth.txt", "# stamps\n1 depth/0.png\n2\n") == f.file("depth.txt") + ":3: a line must have 2 columns");
  CHECK(with("depth.txt", "one depth/0.png\n") == f.file("depth.txt") + ":1: 'one' is not a time stamp");
  CHECK(with("depth.txt", "nan depth/0.png\n") == f.file("depth.txt") + ":1: 'nan' is not a time stamp");
  CHECK(with("depth.txt", "2 depth/0.png\n1 depth/1.png\n") ==
        f.file("depth.txt") + ":2: the stamp 1 is not later than 2 of the line before");
  CHECK(with("associations.txt", "1 depth/0.png 1\n") == f.file("associations.txt") + ":1: a line must have 4 columns");
  CHECK(with("associations.txt", "1 a/0.png 1 b/0.png\n") ==
        f.file("associations.txt") + ":1: one of the two files, and one only, must have 'depth' in its path");
  f.list("depth.txt", "1 depth/0.png\n2 depth/1.png\n");
  CHECK(with("groundtruth.txt", "1 0 0 0 0 0 0\n") ==
        f.file("groundtruth.txt") + ":1:1: has 7 numbers, not the 8 of 'stamp tx ty tz qx qy qz qw'");
  CHECK(with("groundtruth.txt", "1 0 0 nan 0 0 0 1\n") ==
        f.file("groundtruth.txt") + ":1:1: 'nan' is no finite number");
  write_bytes(f.folder / "depth/1.png", file_bytes(f.folder / "depth/1.png").substr(0, 60));
  CHECK(f.error() == f.file("depth/1.png") + " (frame 1): is a broken PNG image: the file is cut short");
}

TEST_CASE("a focal length of 0 is refused, a negative fy is not") {
  CHECK_THROWS_AS(SourceReader("source.tum_rgbd", "{path: x, fy: 0}"), ConfigError);
  CHECK_NOTHROW(SourceReader("source.tum_rgbd", "{path: x, fy: -240}"));
}

TEST_CASE("the living room's frames agree with each other: its y axis points up, its poses are camera to world") {
  const auto room = data_path("icl_kt3");
  if (!room) return;
  TumSettings settings;
  settings.path = *room;
  settings.fx = 240.6, settings.fy = -240, settings.cx = 159.75, settings.cy = 119.75;
  const TumSequence sequence(settings);
  settings.fy = 240;
  const TumSequence flipped(settings);
  REQUIRE(sequence.size() == 100);
  CHECK(sequence.remarks() ==
        std::vector<std::string>{"associations.txt lists 1240 images; only 1.png to 100.png are there"});
  for (int i = 0; i < 60; i += 10) {  // 13 to 15 mm is the noise of these images; 18 to 23 mm with the wrong sign
    INFO("frames " << i << " and " << i + 40);
    const double right = reprojection_median(sequence.read(i), sequence.read(i + 40));
    CHECK(right < 0.016);
    CHECK(right < 0.8 * reprojection_median(flipped.read(i), flipped.read(i + 40)));
  }
}
