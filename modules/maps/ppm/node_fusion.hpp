#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

namespace ppm {

/// What the texels of several faces say where they meet: how far the surface lies along one common normal.
class OffsetFusion {
 public:
  /// mean, variance: of the surface at a texel, along its face's normal; cosine: between that and the common normal.
  void add(double mean, double variance, double cosine) {
    const double c = std::max(cosine, kCosineLeast), information = 1 / variance;
    information_ += information;
    moved_ += c * mean * information;
    reach_ += c * c * information;
    ++count_;
  }
  /// m along the common normal: nearest, weighted by information, to the planes that the texels describe. Where the
  /// faces are in one plane it is the information-weighted mean.
  float offset() const { return static_cast<float>(moved_ / reach_); }
  /// m^2, harmonic mean: texels that meet in a point are one place measured once, not so many independent measurements.
  float variance() const { return static_cast<float>(count_ / information_); }

 private:
  static constexpr double kCosineLeast = 0.5;  // a texel across a sharp crease pushes no further than twice its mean
  double information_ = 0, moved_ = 0, reach_ = 0, count_ = 0;
};

/// Their colour: the information-weighted mean.
class ColorFusion {
 public:
  void add(const Eigen::Vector3d& color, double variance) {
    information_ += 1 / variance;
    weighted_ += color / variance;
  }
  Eigen::Vector3f color() const { return (weighted_ / information_).cast<float>(); }

 private:
  double information_ = 0;
  Eigen::Vector3d weighted_ = Eigen::Vector3d::Zero();
};

}  // namespace ppm
