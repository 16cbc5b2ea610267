#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/core/se3.hpp"
#include "framework/slam/frame.hpp"

namespace ppm {

/// One image seen from where it is thought to have been taken: what is measured there, and what others of its points say
/// should be.
class PosedImage {
 public:
  /// Keeps the depths alone.
  PosedImage(const Frame& frame, const Pose& T_map_camera);

  /// Measured depth at a pixel, m; no number where there is none, or one of its eight neighbours has none or lies more than
  /// kJump_m nearer or farther.
  float smooth_depth(int x, int y) const { return smooth_[index(x, y)]; }
  /// Depth at a point of the image, bilinear in inverse depth (in which planes are linear), m; no number where one of the
  /// four pixels around it is not smooth.
  double smooth_depth_at(const Eigen::Vector2d& pixel) const;
  float depth(int x, int y) const { return depth_[index(x, y)]; }
  const Camera& camera() const { return camera_; }
  const Pose& T_map_camera() const { return T_map_camera_; }

  static constexpr float kJump_m = 0.05f;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.cols) + static_cast<std::size_t>(x);
  }
  Camera camera_;
  Pose T_map_camera_;
  std::vector<float> depth_, smooth_;  // [rows*cols] m
};

/// Share of the measured points of `from` (a grid of about 16 columns) that `to` measures within 20 cm; 0 where the two
/// look in directions more than 60 degrees apart.
double overlap(const PosedImage& from, const PosedImage& to);

/// How far images disagree about the surfaces that they share.
struct ReprojectionError {
  std::size_t pairs = 0;   ///< of images that were compared
  std::size_t pixels = 0;  ///< differences that were taken, both ways
  double median_mm = 0;    ///< of the absolute differences up to 10 cm; NaN where there is none
  double mean_mm = 0;      ///< of the same
  double beyond_10cm = 0;  ///< share of all differences that are larger: something else is seen there, or the poses are far off
};

/// Collects |z measured - z of the projected point| over pairs of images: points of a grid of about 80 columns of one, where
/// it is smooth, projected into the other.
class ReprojectionScorer {
 public:
  /// Compares both ways.
  void add(const PosedImage& a, const PosedImage& b);
  /// Throws DataError where nothing was compared.
  ReprojectionError score() const;
  bool empty() const { return near_m_.empty() && beyond_ == 0; }

 private:
  void add_one_way(const PosedImage& from, const PosedImage& to);
  std::size_t pairs_ = 0, beyond_ = 0;
  std::vector<double> near_m_;
};

}  // namespace ppm
