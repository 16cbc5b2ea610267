#include <catch2/catch.hpp>
#include <fmt/core.h>

#include "modules/sources/seven_scenes_sequence.hpp"
#include "tests/sources/image_writer.hpp"
#include "tests/sources/reprojection.hpp"
#include "tests/sources/source_reader.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr int kCols = 8, kRows = 6;

/// A folder with images 0 .. n-1 of constant depth 1 m + index mm, camera moving along x by 1 cm an image.
class Scene {
 public:
  explicit Scene(int n) {
    write_bytes(folder / "camera-intrinsics.txt", "10 0 4\n0 11 3\n0 0 1\n");
    for (int i = 0; i < n; ++i) {
      write_gray16(file(i, "depth.png"), kCols, kRows,
                   std::vector<std::uint16_t>(kCols * kRows, static_cast<std::uint16_t>(1000 + i)));
      write_bytes(file(i, "pose.txt"), fmt::format("1 0 0 {}\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", 0.01 * i));
    }
  }
  std::filesystem::path file(int i, const std::string& what) const {
    return folder / fmt::format("frame-{:06}.{}", i, what);
  }
  std::string params(const std::string& more = "") const {
    return fmt::format("{{path: \"{}\"{}}}", folder.path().string(), more);
  }
  std::string error(const std::string& more = "") const { return data_error("source.seven_scenes", params(more)); }
  /// The message about a file of image i.
  std::string about(int i, const std::string& what, const std::string& reason) const {
    return fmt::format("{} (frame {}): {}", file(i, what).string(), i, reason);
  }

  TempFolder folder;
};

}  // namespace

TEST_CASE("a folder gives its images in order, with depth in metres and poses") {
  const Scene scene(12);
  SourceReader reader("source.seven_scenes", scene.params());
  for (int i = 0; i < 12; ++i) {
    const auto frame = reader.next();
    REQUIRE(frame);
    CHECK(frame->index == i);
    CHECK(frame->stamp_s == Approx(i / 30.0));
    CHECK(frame->camera == Camera{kCols, kRows, 10, 11, 4, 3});
    CHECK(frame->depth[5] == Approx(1 + 0.001 * i));
    CHECK(frame->sigma[5] > 0);
    CHECK(frame->color.empty());
    CHECK(frame->T_world_camera_ref->translation().x() == Approx(0.01 * i));
  }
  CHECK_FALSE(reader.next());
}

TEST_CASE("0 and 65535 are no depth") {
  const Scene scene(1);
  std::vector<std::uint16_t> depths(kCols * kRows, 2000);
  depths[3] = 0;
  depths[4] = 65535;
  write_gray16(scene.file(0, "depth.png"), kCols, kRows, depths);
  const auto frame = SourceReader("source.seven_scenes", scene.params(", max_range: 100 m")).next();
  CHECK(frame->valid(2));
  CHECK_FALSE(frame->valid(3));
  CHECK_FALSE(frame->valid(4));
}

TEST_CASE("a rounded rotation is made orthonormal") {
  const Scene scene(1);
  write_bytes(scene.file(0, "pose.txt"), "0.8001 -0.6 0 1\n0.6 0.8 0.0002 2\n0 0 1 3\n0 0 0 1\n");
  const auto frame = SourceReader("source.seven_scenes", scene.params()).next();
  const Eigen::Matrix3d R = frame->T_world_camera_ref->linear();
  CHECK((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < 1e-12);
  CHECK(R(0, 0) == Approx(0.8).margin(1e-3));
}

TEST_CASE("gaps in the numbering are reported, and stamps keep them") {
  const Scene scene(9);
  for (int i : {3, 4, 7}) std::filesystem::remove(scene.file(i, "depth.png"));
  const SevenScenesSequence sequence({scene.folder.path()});
  REQUIRE(sequence.size() == 6);
  CHECK(sequence.read(3).index == 3);
  CHECK(sequence.read(3).stamp_s == Approx(5 / 30.0));
  CHECK(sequence.remarks() ==
        std::vector<std::string>{"images are missing: 3 in 2 gaps of the numbering, the first after frame-000002"});
  CHECK(SevenScenesSequence({Scene(3).folder.path()}).remarks().empty());
}

TEST_CASE("colour comes with the depth image when asked for") {
  const Scene scene(1);
  write_jpeg(scene.file(0, "color.jpg"), kCols, kRows, std::vector<std::uint8_t>(kCols * kRows * 3, 99));
  CHECK(SourceReader("source.seven_scenes", scene.params(", color: true")).next()->color.size() == kCols * kRows * 3);
  write_jpeg(scene.file(0, "color.jpg"), 2 * kCols, kRows, std::vector<std::uint8_t>(2 * kCols * kRows * 3, 99));
  CHECK(scene.error(", color: true") == scene.about(0, "color.jpg", "is 16x6 pixels; its depth image is 8x6"));
  std::filesystem::remove(scene.file(0, "color.jpg"));
  CHECK(scene.error(", color: true") == scene.about(0, "color.jpg", "cannot be opened: No such file or directory"));
}

TEST_CASE("a folder that cannot be used says why, once") {
  const Scene scene(2);
  const TempFolder empty;
  const auto error = [](const std::filesystem::path& path) {
    return data_error("source.seven_scenes", "{path: \"" + path.string() + "\"}");
  };
  CHECK(error(empty.path()) == empty.path().string() + ": has no images (frame-NNNNNN.depth.png)");
  CHECK(error(empty / "none") == (empty / "none").string() + ": there is no such folder");
  CHECK(error(scene.file(0, "pose.txt")) == scene.file(0, "pose.txt").string() + ": is no folder");

  const auto intrinsics = scene.folder / "camera-intrinsics.txt";
  const auto with = [&](const std::string& text) {
    write_bytes(intrinsics, text);
    return scene.error();
  };
  const std::string prefix = intrinsics.string() + ": ";
  CHECK(with("10 0 4\n0 11 3\n") == prefix + "has 6 numbers; it must have 9");
  CHECK(with("10 0 4\n0 eleven 3\n0 0 1") == prefix + "'eleven' is not a number");
  CHECK(with("0 0 4\n0 11 3\n0 0 1") == prefix + "is no camera matrix (fx 0 cx; 0 fy cy; 0 0 1 with fx, fy > 0)");
  std::filesystem::remove(intrinsics);
  CHECK(scene.error() == prefix + "cannot be opened: No such file or directory");
}

TEST_CASE("a broken pose is named with its frame") {
  const Scene scene(3);
  const auto with = [&](const std::string& text) {
    write_bytes(scene.file(1, "pose.txt"), text);
    return scene.error();
  };
  const auto expect = [&](const std::string& reason) { return scene.about(1, "pose.txt", reason); };
  CHECK(with("1 0 0 nan\n0 1 0 0\n0 0 1 0\n0 0 0 1") == expect("'nan' is not a finite number"));
  CHECK(with("1 0 0 -1.#IND\n0 1 0 0\n0 0 1 0\n0 0 0 1") == expect("'-1.#IND' is not a number"));
  CHECK(with("1 0 0 0\n0 1 0 0\n0 0 1 0\n") == expect("has 12 numbers; it must have 16"));
  CHECK(with("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 2") == expect("is no pose: the last row must be 0 0 0 1"));
  CHECK(with("2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1") == expect("is no pose: its rotation is not orthonormal (off by 3)"));
  CHECK(with("-1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1") == expect("is no pose: it mirrors"));
  CHECK(with("0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 1") == expect("is no pose: its rotation is not orthonormal (off by 1)"));
  std::filesystem::remove(scene.file(1, "pose.txt"));
  CHECK(scene.error() == expect("cannot be opened: No such file or directory"));
}

TEST_CASE("a broken depth image is named with its frame") {
  const Scene scene(3);
  const auto file = scene.file(2, "depth.png");
  const std::string whole = file_bytes(file);
  write_bytes(file, whole.substr(0, whole.size() / 2));
  CHECK(scene.error() == scene.about(2, "depth.png", "is a broken PNG image: the file is cut short"));
  CHECK(scene.error(", last: 1") == "no error");
}

TEST_CASE("an image of another size is named with its frame") {
  const Scene scene(3);
  write_gray16(scene.file(2, "depth.png"), 4, 2, std::vector<std::uint16_t>(8, 1000));
  CHECK(scene.error() == scene.about(2, "depth.png", "is 4x2 pixels; the sequence began with 8x6"));
}

TEST_CASE("the kitchen's frames agree with each other through its poses") {
  const auto kitchen = data_path("kitchen");
  if (!kitchen) return;
  const SevenScenesSequence sequence({*kitchen});
  REQUIRE(sequence.size() == 1000);
  CHECK(sequence.remarks().empty());
  std::vector<double> medians;
  for (int i = 0; i < 1000; i += 50) medians.push_back(reprojection_median(sequence.read(i), sequence.read(i + 1)));
  CHECK(median(medians) < 0.006);
  CHECK(*std::max_element(medians.begin(), medians.end()) < 0.012);  // where the view is far
}
