// Rawlogs as MRPT writes them.
#include <catch2/catch.hpp>
#include <fstream>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <thread>

#include "framework/core/error.hpp"
#include "modules/sources/rawlog_sequence.hpp"
#include "tests/sources/rawlog_files.hpp"
#include "tests/support/temp_folder.hpp"

namespace {

using namespace mrpt::obs;
using Catch::Matchers::Contains;
using ppm::test::MrptObjects;
using ppm::test::small_scan;
using ppm::test::write_rawlog;
using ppm::test::TempFolder;

ppm::RawlogSequence opened(const std::filesystem::path& file, ppm::RawlogSettings settings = {}) {
  settings.path = file;
  return ppm::RawlogSequence(settings);
}

CObservationOdometry::Ptr odometry(double stamp_s, double x, double y, double phi) {
  auto out = CObservationOdometry::Create();
  out->timestamp = mrpt::Clock::fromDouble(stamp_s);
  out->odometry = mrpt::poses::CPose2D(x, y, phi);
  return out;
}

CObservationIMU::Ptr imu(double stamp_s, const mrpt::poses::CPose3D& place) {
  auto out = CObservationIMU::Create();
  out->timestamp = mrpt::Clock::fromDouble(stamp_s);
  out->sensorPose = place;
  out->set(IMU_WX, 1), out->set(IMU_WY, 2), out->set(IMU_WZ, 3);
  out->set(IMU_X_ACC, 4), out->set(IMU_Y_ACC, 5), out->set(IMU_Z_ACC, 6);
  return out;
}

}  // namespace

TEST_CASE("observations alone: depth, lens, times and place of the camera, odometry and inertial samples") {
  TempFolder folder;
  const bool compressed = GENERATE(false, true);
  auto first = small_scan(1e9 + 0.1, 1000), second = small_scan(1e9 + 0.2, 2000);
  first->sensorPose = second->sensorPose = mrpt::poses::CPose3D(0.1, 0.2, 0.3, 0, 0, 0);
  write_rawlog(folder / "a.rawlog",
               {first, odometry(1e9 + 0.08, 1, 2, 0), odometry(1e9 + 0.12, 2, 4, 0.4), second,
                imu(1e9 + 0.11, {0, 0, 0, 0, 0, 0}), imu(1e9 + 0.15, {0, 0, 0, M_PI / 2, 0, 0}), imu(1e9 + 0.25, {}),
                CObservationComment::Create()},
               compressed);
  const auto log = opened(folder / "a.rawlog");
  REQUIRE(log.size() == 2);
  CHECK(log.stamp_s(0) == Approx(1e9 + 0.1).epsilon(1e-16));
  ppm::Frame frame = log.read(1);
  CHECK(frame.index == 1);
  CHECK(frame.camera == ppm::Camera{4, 3, 5, 6, 1.5, 1});
  CHECK(frame.depth[5] == static_cast<float>(2.005));
  CHECK_FALSE(frame.valid(11));
  // The camera looks along the body's x.
  CHECK((frame.T_base_camera * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1.1, 0.2, 0.3)));
  CHECK((frame.T_base_camera * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0.1, -0.8, 0.3)));
  log.add_motion(1e9 + 0.1, frame);
  REQUIRE(frame.imu.size() == 2);
  CHECK(frame.imu[0].gyro == Eigen::Vector3d(1, 2, 3));
  CHECK(frame.imu[1].accel.isApprox(Eigen::Vector3d(-5, 4, 6)));
  REQUIRE(frame.T_odom_base);
  CHECK(frame.T_odom_base->translation().isApprox(Eigen::Vector3d(2, 4, 0)));  // of 80 ms before
  ppm::Frame earlier = log.read(0);
  log.add_motion(-1, earlier);
  CHECK(earlier.imu.empty());
  REQUIRE(earlier.T_odom_base);
  CHECK(earlier.T_odom_base->translation().isApprox(Eigen::Vector3d(1.5, 3, 0), 1e-6));
  CHECK(std::atan2((*earlier.T_odom_base)(1, 0), (*earlier.T_odom_base)(0, 0)) == Approx(0.2).epsilon(1e-5));
  CHECK_FALSE(log.reference_pose(0));
  REQUIRE(log.remarks().size() == 1);
  CHECK_THAT(log.remarks()[0], Contains("1 mrpt::obs::CObservationComment"));
}

TEST_CASE("actions and sensory frames: odometry is the sum of the steps, ranges along the ray become depths") {
  TempFolder folder;
  MrptObjects objects;
  for (int k = 0; k < 3; ++k) {
    if (k > 0) {
      CActionRobotMovement2D move;
      move.computeFromOdometry(mrpt::poses::CPose2D(1, 0, M_PI / 2), {});
      auto actions = CActionCollection::Create();
      actions->insert(move);
      objects.push_back(actions);
    }
    auto scan = small_scan(k, 1000);
    scan->range_is_depth = false;
    auto frame = CSensoryFrame::Create();
    frame->insert(imu(k, {}));
    frame->insert(scan);
    objects.push_back(frame);
  }
  write_rawlog(folder / "b.rawlog", objects);
  const auto log = opened(folder / "b.rawlog");
  REQUIRE(log.size() == 3);
  ppm::Frame frame = log.read(2);
  log.add_motion(1, frame);
  CHECK(frame.imu.size() == 1);
  REQUIRE(frame.T_odom_base);
  CHECK(frame.T_odom_base->translation().isApprox(Eigen::Vector3d(1, 1, 0), 1e-9));
  const double x = (0 - 1.5) / 5, y = (2 - 1) / 6.0;
  CHECK(frame.depth[8] == Approx(1.008 / std::sqrt(1 + x * x + y * y)).epsilon(1e-6));
}

TEST_CASE("points without a range image, and range images in files of their own, are depth too") {
  TempFolder folder;
  auto points = small_scan(1, 1000);
  points->hasRangeImage = false;
  points->hasPoints3D = true;
  points->resizePoints3DVectors(2);
  points->points3D_x = {1.5f, 2.5f}, points->points3D_y = {0, 0}, points->points3D_z = {0, 0};
  points->points3D_idxs_x = {3, 0}, points->points3D_idxs_y = {0, 2};
  auto outside = small_scan(2, 3000);
  std::filesystem::create_directory(folder / "c_Images");
  outside->rangeImage_convertToExternalStorage("range2", (folder / "c_Images").string());
  write_rawlog(folder / "c.rawlog", {points, outside});
  const auto log = opened(folder / "c.rawlog");
  const auto of_points = log.read(0);
  CHECK(of_points.depth[3] == 1.5f);
  CHECK(of_points.depth[8] == 2.5f);
  CHECK_FALSE(of_points.valid(0));
  CHECK(log.read(1).depth[7] == static_cast<float>(3.007));
  std::filesystem::remove_all(folder / "c_Images");
  CHECK_THROWS_AS(log.read(1), ppm::DataError);
}

TEST_CASE("a lens is taken out, each pixel being that whose ray is nearest") {
  TempFolder folder;
  auto scan = small_scan(1, 1000);
  scan->cameraParams.setDistortionPlumbBob(120, 0, 0, 0);  // the corners lie a pixel and more farther out
  write_rawlog(folder / "d.rawlog", {scan});
  const auto frame = opened(folder / "d.rawlog").read(0);
  CHECK(frame.depth[5] == static_cast<float>(1.004));  // (1, 1) is seen at (0, 1)
  CHECK_FALSE(frame.valid(0));
  scan->cameraParams.setDistortionKannalaBrandt(0.1, 0, 0, 0);
  write_rawlog(folder / "e.rawlog", {scan});
  CHECK_THROWS_WITH(opened(folder / "e.rawlog").read(0), Contains("frame 0") && Contains("fisheye"));
}

TEST_CASE("the images of one of several cameras are read, a file with several needs its name") {
  TempFolder folder;
  auto left = small_scan(1, 1000), right = small_scan(0.5, 2000);
  right->sensorLabel = "right";
  write_rawlog(folder / "f.rawlog", {left, right});
  CHECK_THROWS_WITH(opened(folder / "f.rawlog"), Contains("several cameras") && Contains("'right', 'tof'"));
  ppm::RawlogSettings settings;
  settings.camera = "right";
  CHECK(opened(folder / "f.rawlog", settings).read(0).depth[0] == 2.0f);
  settings.camera = "middle";
  CHECK_THROWS_WITH(opened(folder / "f.rawlog", settings), Contains("no range image of 'middle'"));
}

TEST_CASE("files that are no rawlog, cut short, or without images are refused with the place") {
  TempFolder folder;
  const auto refused = [&](const std::string& name, const std::string& reason) {
    CHECK_THROWS_WITH(opened(folder / name), Contains(name) && Contains(reason));
    CHECK_THROWS_AS(opened(folder / name), ppm::DataError);
  };
  refused("missing.rawlog", "No such file");
  write_rawlog(folder / "odometry.rawlog", {odometry(1, 0, 0, 0)});
  refused("odometry.rawlog", "no range image");
  std::ofstream(folder / "text.rawlog") << "this is no rawlog at all, but some words of text";
  refused("text.rawlog", "entry 0, from byte 0");
  for (const bool compressed : {false, true}) {
    write_rawlog(folder / "cut.rawlog", {small_scan(1, 1000), small_scan(2, 1000)}, compressed);
    std::filesystem::resize_file(folder / "cut.rawlog", std::filesystem::file_size(folder / "cut.rawlog") - 40);
    refused("cut.rawlog", "cut short");
  }
  write_rawlog(folder / "pose.rawlog", {std::make_shared<mrpt::poses::CPose3D>()});
  refused("pose.rawlog", "a mrpt::poses::CPose3D, which is no observation");
  auto timeless = small_scan(1, 1000);
  timeless->timestamp = INVALID_TIMESTAMP;
  write_rawlog(folder / "timeless.rawlog", {timeless});
  refused("timeless.rawlog", "without a time");
  auto wrong = small_scan(1, 1000);
  wrong->cameraParams.setIntrinsicParamsFromValues(0, 6, 1.5, 1);
  write_rawlog(folder / "lens.rawlog", {wrong});
  CHECK_THROWS_WITH(opened(folder / "lens.rawlog").read(0), Contains("frame 0") && Contains("no focal length"));
  ppm::RawlogSettings colored;
  colored.color = true;
  CHECK_THROWS_WITH(opened(folder / "pose.rawlog", colored), Contains("pose.rawlog"));
  write_rawlog(folder / "grey.rawlog", {small_scan(1, 1000)});
  CHECK_THROWS_WITH(opened(folder / "grey.rawlog", colored).read(0), Contains("frame 0") && Contains("colour"));
}

TEST_CASE("images are the same in any order and on several threads") {
  TempFolder folder;
  MrptObjects objects;
  for (int k = 0; k < 20; ++k) objects.push_back(small_scan(k, 100 * k + 100));
  write_rawlog(folder / "g.rawlog", objects, true);
  const auto log = opened(folder / "g.rawlog");
  std::vector<float> seen(20), again(20);
  std::thread other([&] {
    for (int k = 19; k >= 0; --k) again[static_cast<std::size_t>(k)] = log.read(k).depth[3];
  });
  for (int k = 0; k < 20; ++k) seen[static_cast<std::size_t>(k)] = log.read(k).depth[3];
  other.join();
  CHECK(seen == again);
  CHECK(seen[7] == static_cast<float>(0.803));
}
