#include "modules/rawlog/writer.hpp"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "framework/core/error.hpp"
#include "modules/rawlog/mrpt_pose.hpp"

namespace ppm {

namespace {

using namespace mrpt::obs;

CObservationIMU observation_of(const ImuSample& sample) {
  CObservationIMU out;
  out.timestamp = mrpt::Clock::fromDouble(sample.stamp_s);
  out.sensorLabel = "imu";
  out.set(IMU_WX, sample.gyro.x());
  out.set(IMU_WY, sample.gyro.y());
  out.set(IMU_WZ, sample.gyro.z());
  out.set(IMU_X_ACC, sample.accel.x());
  out.set(IMU_Y_ACC, sample.accel.y());
  out.set(IMU_Z_ACC, sample.accel.z());
  return out;
}

CObservationRobotPose observation_of(const Pose& T_world_base, double stamp_s, const char* label) {
  CObservationRobotPose out;
  out.timestamp = mrpt::Clock::fromDouble(stamp_s);
  out.sensorLabel = label;
  out.pose = mrpt::poses::CPose3DPDFGaussian(to_mrpt(T_world_base));
  return out;
}

void add_depth(const Frame& frame, double unit_m, CObservation3DRangeScan& scan) {
  const Camera& camera = frame.camera;
  const double units_per_m = std::round(1 / unit_m);
  scan.hasRangeImage = true;
  scan.range_is_depth = true;
  scan.rangeUnits = static_cast<float>(1 / units_per_m);
  scan.rangeImage_setSize(camera.rows, camera.cols);
  for (int y = 0, i = 0; y < camera.rows; ++y)
    for (int x = 0; x < camera.cols; ++x, ++i) {
      const double depth = frame.valid(i) ? static_cast<double>(frame.depth[static_cast<std::size_t>(i)]) : 0.0;
      const double units = std::round(depth * units_per_m);
      if (!(units <= std::numeric_limits<std::uint16_t>::max()))
        throw DataError("the source", frame.index,
                        fmt::format("a depth of {} m does not fit a rawlog in units of {} m", depth, 1 / units_per_m));
      scan.rangeImage(y, x) = static_cast<std::uint16_t>(units);
    }
  scan.cameraParams.ncols = static_cast<std::uint32_t>(camera.cols);
  scan.cameraParams.nrows = static_cast<std::uint32_t>(camera.rows);
  scan.cameraParams.setIntrinsicParamsFromValues(camera.fx, camera.fy, camera.cx, camera.cy);
  scan.cameraParamsIntensity = scan.cameraParams;
}

void add_color(const Frame& frame, CObservation3DRangeScan& scan) {
  const auto cols = static_cast<std::size_t>(frame.camera.cols), rows = static_cast<std::size_t>(frame.camera.rows);
  scan.hasIntensityImage = true;
  scan.intensityImage.resize(cols, rows, mrpt::img::CH_RGB);
  const std::uint8_t* rgb = frame.color.data();
  for (std::size_t y = 0; y < rows; ++y) {
    auto* line = scan.intensityImage.ptrLine<std::uint8_t>(static_cast<unsigned>(y));
    for (std::size_t x = 0; x < cols; ++x, rgb += 3, line += 3) line[0] = rgb[2], line[1] = rgb[1], line[2] = rgb[0];
  }
}

CObservation3DRangeScan scan_of(const Frame& frame, const RawlogFormat& format) {
  CObservation3DRangeScan scan;
  scan.timestamp = mrpt::Clock::fromDouble(frame.stamp_s);
  scan.sensorLabel = format.label;
  scan.sensorPose = to_mrpt(frame.T_base_camera * T_sensor_camera().inverse());
  add_depth(frame, format.range_unit_m, scan);
  if (!frame.color.empty()) add_color(frame, scan);
  return scan;
}

}  // namespace

std::string rawlog_bytes(const Frame& frame, const RawlogFormat& format) {
  mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true);
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom(memory);
  for (const auto& sample : frame.imu) archive << observation_of(sample);
  if (frame.T_odom_base) archive << observation_of(*frame.T_odom_base, frame.stamp_s, kRawlogOdometry);
  if (frame.T_world_camera_ref)
    archive << observation_of(*frame.T_world_camera_ref * frame.T_base_camera.inverse(), frame.stamp_s, kRawlogReference);
  archive << scan_of(frame, format);
  return {static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount()};
}

}  // namespace ppm
