#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "framework/slam/frame_sequence.hpp"
#include "modules/sources/color_registration.hpp"

namespace ppm {

struct SevenScenesSettings {
  std::filesystem::path path;  ///< see data_folder
  double depth_scale = 1000;   ///< units per m
  double rate_hz = 30;         ///< stamp = number / rate
  bool color = false;
  ColorCamera color_camera{};
};

/// frame-NNNNNN.{depth.png, pose.txt, color.jpg} and camera-intrinsics.txt in one folder, in the order of their
/// numbers. An image's index is its place in that order: without gaps and from 0 on, the number itself.
/// All images have the size of the first one.
class SevenScenesSequence final : public FrameSequence {
 public:
  /// Throws DataError: no such folder, no images, broken intrinsics, broken first image.
  explicit SevenScenesSequence(const SevenScenesSettings& settings);

  std::string name() const override { return folder_.string(); }
  std::int64_t size() const override { return static_cast<std::int64_t>(images_.size()); }
  Frame read(std::int64_t index) const override;
  double stamp_s(std::int64_t index) const override;
  std::optional<Pose> reference_pose(std::int64_t index) const override;
  std::vector<std::string> remarks() const override;  ///< gaps in the numbering

 private:
  struct Image {
    std::int64_t number;
    std::string stem;  // "frame-000123"
  };
  void list_images();
  const Image& image(std::int64_t index) const { return images_[static_cast<std::size_t>(index)]; }
  std::filesystem::path file(std::int64_t index, const char* suffix) const {
    return folder_ / (image(index).stem + suffix);
  }

  SevenScenesSettings settings_;
  std::filesystem::path folder_;
  std::vector<Image> images_;
  Camera camera_;
};

}  // namespace ppm
