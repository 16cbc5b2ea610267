#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/slam/frame.hpp"
#include "framework/slam/trajectory.hpp"

namespace ppm {

/// A range image of a rawlog, before it is read.
struct RawlogScan {
  double stamp_s = 0;  ///< Unix time
  std::string label;   ///< of the sensor
  Pose T_base_camera = Pose::Identity();
};

/// The recordings of a rawlog of MRPT. Immutable once opened; images are read when they are asked for.
/// A compressed file is unpacked once, when it is opened, to a temporary file without a name.
class Rawlog {
 public:
  virtual ~Rawlog() = default;
  /// The image of scans()[i], at full resolution, lens distortion taken out pixel by pixel: stamp, camera, T_base_camera, depth,
  /// confidence where it has that. with_color: it must have a colour image that is registered to depth. The same bytes
  /// whenever and on whatever thread. Throws DataError naming file and frame (i).
  virtual Frame read(std::size_t i, bool with_color) const = 0;

  // In order of time.
  const std::vector<RawlogScan>& scans() const { return scans_; }
  const std::vector<ImuSample>& imu() const { return imu_; }
  /// T_odom_base; of odometry in the plane, its poses lifted.
  const std::vector<StampedPose>& odometry() const { return odometry_; }
  /// Poses of the body from elsewhere (CObservationRobotPose), by the label of the sensor.
  const std::map<std::string, std::vector<StampedPose>>& poses() const { return poses_; }
  /// What is in the file and is not used, a sentence each.
  const std::vector<std::string>& remarks() const { return remarks_; }

 protected:
  std::vector<RawlogScan> scans_;
  std::vector<ImuSample> imu_;
  std::vector<StampedPose> odometry_;
  std::map<std::string, std::vector<StampedPose>> poses_;
  std::vector<std::string> remarks_;
};

/// How frames are written.
struct RawlogFormat {
  std::string label = "depth";  ///< of the camera
  double range_unit_m = 0.001;  ///< of the integers that depths are rounded to
};
/// Labels of the poses (CObservationRobotPose) that hold a frame's odometry and reference.
constexpr const char* kRawlogOdometry = "odometry";
constexpr const char* kRawlogReference = "reference";

/// What speaks MRPT: a library of its own, loaded when it is first needed, since MRPT's recordings bring OpenCV, GDAL and
/// some hundred libraries more.
struct RawlogLibrary {
  /// Throws DataError: no such file, a file that is no rawlog, cut short or damaged (with the entry and the byte).
  std::unique_ptr<const Rawlog> (*open)(const std::filesystem::path& file);
  /// A frame's observations, in order of time, as they stand in a rawlog. Throws DataError where a depth does not fit
  /// the format.
  std::string (*frame_bytes)(const Frame& frame, const RawlogFormat& format);

  /// Throws Error where the library is not there.
  static const RawlogLibrary& get();
};

}  // namespace ppm
