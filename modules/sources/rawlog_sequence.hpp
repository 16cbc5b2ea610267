#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "framework/slam/frame_sequence.hpp"
#include "modules/rawlog/rawlog.hpp"

namespace ppm {

struct RawlogSettings {
  std::filesystem::path path;
  std::string camera;                        ///< label of the sensor; "": there is one
  bool color = false;
  std::string odometry = kRawlogOdometry;    ///< label of poses that are odometry in space
  std::string reference = kRawlogReference;  ///< label of poses that are the reference
  double max_dt_s = 0.1;                     ///< see pose_at
};

/// The range images of one camera of a rawlog, in order of time, with the inertial samples, odometry and reference
/// poses that were recorded beside them.
class RawlogSequence final : public FrameSequence {
 public:
  /// Throws DataError: see RawlogLibrary; no range image of that camera, or of several cameras and none named.
  explicit RawlogSequence(const RawlogSettings& settings);

  std::string name() const override { return file_.string(); }
  std::int64_t size() const override { return static_cast<std::int64_t>(images_.size()); }
  Frame read(std::int64_t index) const override;
  void add_motion(double after_s, Frame& image) const override;
  double stamp_s(std::int64_t index) const override { return scan(index).stamp_s; }
  std::optional<Pose> reference_pose(std::int64_t index) const override;
  std::vector<std::string> remarks() const override { return log_->remarks(); }

 private:
  const RawlogScan& scan(std::int64_t index) const { return log_->scans()[images_.at(static_cast<std::size_t>(index))]; }
  void choose_images();

  RawlogSettings settings_;
  std::filesystem::path file_;
  std::unique_ptr<const Rawlog> log_;
  std::vector<std::size_t> images_;  // of log_'s scans
};

}  // namespace ppm
