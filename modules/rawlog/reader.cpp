#include "modules/rawlog/reader.hpp"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "framework/core/error.hpp"
#include "modules/rawlog/mrpt_pose.hpp"
#include "modules/rawlog/object_stream.hpp"
#include "modules/rawlog/scan_image.hpp"

namespace ppm {

namespace {

using namespace mrpt::obs;

template <class T>
void sort_by_time(std::vector<T>& values) {
  std::ranges::stable_sort(values, {}, &T::stamp_s);
}

/// Where an observation stands: its object, and its number in that where it is a sensory frame.
struct ScanPlace {
  std::uint64_t begin = 0, end = 0;
  std::size_t part = 0;
};

/// Where MRPT keeps the outside files of a rawlog: NAME_Images beside NAME.rawlog, or Images.
std::string folder_of_images(const std::filesystem::path& file) {
  auto own = file;
  own.replace_filename(file.stem().string() + "_Images");
  return (std::filesystem::is_directory(own) ? own : file.parent_path() / "Images").string();
}

/// MRPT looks for outside files in one folder, which is the same for the whole program.
std::mutex& outside_files() {
  static std::mutex mutex;
  return mutex;
}

class FileRawlog final : public Rawlog {
 public:
  explicit FileRawlog(const std::filesystem::path& file)
      : name_(file.string()), spool_(file), images_(folder_of_images(file)) {
    ObjectStream stream(spool_, name_);
    while (const auto object = stream.next()) add(*object, {stream.begin(), stream.end(), 0});
    if (!has_actions_) steps_.clear();
    if (odometry_.empty()) odometry_ = std::move(steps_);
    put_in_order();
    for (const auto& [what, n] : unused_) remarks_.push_back(fmt::format("{} {} are not used", n, what));
  }

  Frame read(std::size_t i, bool with_color) const override {
    try {
      const auto& place = places_.at(i);
      const auto object = object_at(spool_, place.begin, place.end);
      auto scan = std::dynamic_pointer_cast<CObservation3DRangeScan>(object);
      if (const auto many = std::dynamic_pointer_cast<CSensoryFrame>(object))
        scan = many->getObservationByIndexAs<CObservation3DRangeScan::Ptr>(place.part);
      PPM_CHECK(scan, "entry at byte {} is no scan any more", place.begin);
      std::lock_guard lock(outside_files());
      mrpt::img::CImage::setImagesPathBase(images_);
      scan->load();
      Frame frame = frame_of_scan(*scan, with_color);
      frame.stamp_s = scans_[i].stamp_s;
      return frame;
    } catch (const Error&) {
      throw;
    } catch (const std::exception& error) {
      throw DataError(name_, static_cast<std::int64_t>(i), reason_of(error));
    }
  }

 private:
  void add(const mrpt::serialization::CSerializable& object, ScanPlace place);
  void add(const CObservation& observation, const ScanPlace& place);
  void add(const CObservationIMU& sample, double stamp_s);
  void put_in_order();
  double stamp_of(const CObservation& observation, const ScanPlace& place) const;

  std::string name_;
  Spool spool_;
  std::string images_;
  std::vector<ScanPlace> places_;  // of scans_
  std::map<std::string, std::size_t> unused_;
  // The format of actions and sensory frames: odometry as the sum of increments.
  bool has_actions_ = false;
  Pose sum_ = Pose::Identity();
  std::vector<StampedPose> steps_;
};

void FileRawlog::add(const mrpt::serialization::CSerializable& object, ScanPlace place) {
  if (const auto* observation = dynamic_cast<const CObservation*>(&object)) return add(*observation, place);
  if (const auto* many = dynamic_cast<const CSensoryFrame*>(&object)) {
    for (const auto& observation : *many) {
      add(*observation, place);
      ++place.part;
    }
    return;
  }
  if (const auto* actions = dynamic_cast<const CActionCollection*>(&object)) {
    mrpt::poses::CPose3D step;
    if (!actions->getFirstMovementEstimationMean(step)) return;
    has_actions_ = true;
    sum_ = sum_ * from_mrpt(step);
    return;
  }
  throw DataError(name_, fmt::format("from byte {} on: a {}, which is no observation", place.begin,
                                     object.GetRuntimeClass()->className));
}

double FileRawlog::stamp_of(const CObservation& observation, const ScanPlace& place) const {
  if (observation.timestamp == INVALID_TIMESTAMP)
    throw DataError(name_, fmt::format("from byte {} on: a {} without a time", place.begin,
                                       observation.GetRuntimeClass()->className));
  return mrpt::Clock::toDouble(observation.timestamp);
}

void FileRawlog::add(const CObservation& observation, const ScanPlace& place) {
  const auto at = [&] { return stamp_of(observation, place); };
  if (const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(&observation)) {
    scans_.push_back({at(), scan->sensorLabel, from_mrpt(scan->sensorPose) * T_sensor_camera()});
    places_.push_back(place);
    steps_.push_back({0, at(), sum_});
  } else if (const auto* imu = dynamic_cast<const CObservationIMU*>(&observation)) {
    add(*imu, at());
  } else if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
    odometry_.push_back({0, at(), from_mrpt(mrpt::poses::CPose3D(odometry->odometry))});
  } else if (const auto* pose = dynamic_cast<const CObservationRobotPose*>(&observation)) {
    poses_[pose->sensorLabel].push_back({0, at(), from_mrpt(pose->pose.mean) * from_mrpt(pose->sensorPose).inverse()});
  } else {
    ++unused_[observation.GetRuntimeClass()->className];
  }
}

void FileRawlog::add(const CObservationIMU& imu, double stamp_s) {
  for (const auto what : {IMU_WX, IMU_WY, IMU_WZ, IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC})
    if (!imu.has(what)) {
      ++unused_["inertial samples without rate or force"];
      return;
    }
  const Pose T_base_imu = from_mrpt(imu.sensorPose);
  if (T_base_imu.translation().norm() > 1e-3) ++unused_["places of inertial samples off the body's origin"];
  const Eigen::Vector3d gyro(imu.get(IMU_WX), imu.get(IMU_WY), imu.get(IMU_WZ));
  const Eigen::Vector3d accel(imu.get(IMU_X_ACC), imu.get(IMU_Y_ACC), imu.get(IMU_Z_ACC));
  imu_.push_back({stamp_s, T_base_imu.linear() * gyro, T_base_imu.linear() * accel});
}

void FileRawlog::put_in_order() {
  std::vector<std::size_t> order(scans_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return scans_[i].stamp_s; });
  std::vector<RawlogScan> scans;
  std::vector<ScanPlace> places;
  for (const auto i : order) scans.push_back(scans_[i]), places.push_back(places_[i]);
  scans_ = std::move(scans);
  places_ = std::move(places);
  sort_by_time(imu_);
  sort_by_time(odometry_);
  for (auto& [label, path] : poses_) sort_by_time(path);
}

}  // namespace

std::unique_ptr<const Rawlog> open_rawlog(const std::filesystem::path& file) {
  return std::make_unique<FileRawlog>(file);
}

}  // namespace ppm
