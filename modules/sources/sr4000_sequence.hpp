#pragma once
#include <filesystem>
#include <vector>

#include "framework/slam/frame_sequence.hpp"
#include "modules/sources/sr4000_image.hpp"

namespace ppm {

struct Sr4000Settings {
  std::filesystem::path path;  ///< see data_folder
  double focal_px = 220;       ///< of the images that are given
  double rate_hz = 30;         ///< stamp = index / rate
};

/// The files *.dat and *.dat.gz of a folder (see read_sr4000), by name. The lens' distortion is taken out: it is fitted
/// to the points of the first image, and each pixel of the images that are given is the pixel of the camera whose ray
/// is nearest, so that no value is a mean of several. Confidence is the amplitude. No poses, no colour.
class Sr4000Sequence final : public FrameSequence {
 public:
  /// Throws DataError: no such folder, no files, a first image that is broken or shows no lens.
  explicit Sr4000Sequence(const Sr4000Settings& settings);

  std::string name() const override { return folder_.string(); }
  std::int64_t size() const override { return static_cast<std::int64_t>(files_.size()); }
  Frame read(std::int64_t index) const override;
  double stamp_s(std::int64_t index) const override { return static_cast<double>(index) / settings_.rate_hz; }
  std::optional<Pose> reference_pose(std::int64_t) const override { return std::nullopt; }

 private:
  void list_files();
  void find_lens();

  Sr4000Settings settings_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
  Camera camera_;
  std::vector<int> source_;  // [rows*cols] the camera's pixel that each given pixel is; -1: outside of its image
};

}  // namespace ppm
