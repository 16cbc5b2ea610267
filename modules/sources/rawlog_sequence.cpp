#include "modules/sources/rawlog_sequence.hpp"

#include <algorithm>
#include <set>

#include "framework/core/data_path.hpp"
#include "framework/core/error.hpp"
#include "modules/sources/pose_lookup.hpp"

namespace ppm {

RawlogSequence::RawlogSequence(const RawlogSettings& settings)
    : settings_(settings),
      file_(expand_data_path(settings.path)),
      log_(RawlogLibrary::get().open(file_)) {
  choose_images();
}

void RawlogSequence::choose_images() {
  std::set<std::string> labels;
  for (std::size_t i = 0; i < log_->scans().size(); ++i) {
    const auto& label = log_->scans()[i].label;
    labels.insert(label);
    if (settings_.camera.empty() || label == settings_.camera) images_.push_back(i);
  }
  if (labels.empty()) throw DataError(file_.string(), "holds no range image (CObservation3DRangeScan)");
  std::string all;
  for (const auto& label : labels) all += fmt::format("{}'{}'", all.empty() ? "" : ", ", label);
  if (images_.empty())
    throw DataError(file_.string(), fmt::format("holds no range image of '{}'; there are those of {}", settings_.camera, all));
  if (settings_.camera.empty() && labels.size() > 1)
    throw DataError(file_.string(), fmt::format("holds range images of several cameras: 'camera' must name one of {}", all));
}

Frame RawlogSequence::read(std::int64_t index) const {
  Frame frame = log_->read(images_.at(static_cast<std::size_t>(index)), settings_.color);
  frame.index = index;
  return frame;
}

void RawlogSequence::add_motion(double after_s, Frame& image) const {
  const auto& imu = log_->imu();
  const auto first = std::ranges::upper_bound(imu, after_s, {}, &ImuSample::stamp_s);
  const auto last = std::ranges::upper_bound(imu, image.stamp_s, {}, &ImuSample::stamp_s);
  image.imu.assign(first, std::max(first, last));
  const auto in_space = log_->poses().find(settings_.odometry);
  const auto& odometry = in_space != log_->poses().end() ? in_space->second : log_->odometry();
  image.T_odom_base = pose_at(odometry, image.stamp_s, settings_.max_dt_s);
}

std::optional<Pose> RawlogSequence::reference_pose(std::int64_t index) const {
  const auto path = log_->poses().find(settings_.reference);
  if (path == log_->poses().end()) return std::nullopt;
  const auto T_world_base = pose_at(path->second, scan(index).stamp_s, settings_.max_dt_s);
  if (!T_world_base) return std::nullopt;
  return *T_world_base * scan(index).T_base_camera;
}

}  // namespace ppm
