#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/slam/frame.hpp"
#include "framework/slam/true_surface.hpp"

namespace ppm {

/// The images of one data set, by index 0 .. size()-1. Immutable once made: an image is the same bytes whenever, in whatever
/// order and on whatever thread it is read.
class FrameSequence {
 public:
  virtual ~FrameSequence() = default;
  /// What messages call the data where no single file is to blame: its folder.
  virtual std::string name() const = 0;
  virtual std::int64_t size() const = 0;
  /// Reads one image at full resolution: index, stamp, camera, depth, confidence, colour, reference pose. sigma may stay empty:
  /// it is then filled from the noise parameters of FrameSource, as lateral_px always is. Throws DataError naming file and frame.
  virtual Frame read(std::int64_t index) const = 0;
  /// Sets what was measured on the way to an image that read() gave: imu, the samples later than after_s up to the image's
  /// stamp, and T_odom_base. after_s: stamp of the image before, of those that are used. Throws DataError.
  virtual void add_motion(double /*after_s*/, Frame& /*image*/) const {}
  virtual double stamp_s(std::int64_t index) const = 0;
  /// The pose that read() would give, without reading the image.
  virtual std::optional<Pose> reference_pose(std::int64_t index) const = 0;
  /// What the images show, where it is known exactly, in the frame of the reference poses; else null. Valid while the sequence
  /// lives.
  virtual std::unique_ptr<const TrueSurface> true_surface() const { return nullptr; }
  /// What is odd about the data and does not forbid its use (gaps in the numbering), a sentence each; logged once.
  virtual std::vector<std::string> remarks() const { return {}; }
};

}  // namespace ppm
