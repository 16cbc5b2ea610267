#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "framework/slam/frame_sequence.hpp"
#include "framework/slam/trajectory.hpp"
#include "modules/sources/tum_list.hpp"

namespace ppm {

struct TumSettings {
  std::filesystem::path path;                         ///< see data_folder
  double fx = 525, fy = 525, cx = 319.5, cy = 239.5;  ///< px; the benchmark's default
  double depth_scale = 5000;                          ///< units per m
  double max_dt_s = 0.02;                             ///< between a depth image and its colour image or reference pose
  bool color = false;
};

/// A folder in TUM layout: the images of list_tum_images, with the poses of groundtruth.txt (see pose_at) where it is.
/// All images have the size of the first one.
class TumSequence final : public FrameSequence {
 public:
  /// Throws DataError: see list_tum_images and read_tum; broken first image.
  explicit TumSequence(const TumSettings& settings);

  std::string name() const override { return folder_.string(); }
  std::int64_t size() const override { return static_cast<std::int64_t>(images_.size()); }
  Frame read(std::int64_t index) const override;
  double stamp_s(std::int64_t index) const override { return image(index).stamp_s; }
  std::optional<Pose> reference_pose(std::int64_t index) const override;
  std::vector<std::string> remarks() const override { return remarks_; }  ///< images and poses that are not there

 private:
  const TumImage& image(std::int64_t index) const { return images_[static_cast<std::size_t>(index)]; }

  TumSettings settings_;
  std::filesystem::path folder_;
  std::vector<TumImage> images_;
  std::vector<StampedPose> path_;
  std::vector<std::string> remarks_;
  Camera camera_;
};

}  // namespace ppm
