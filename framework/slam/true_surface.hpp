#pragma once
#include <Eigen/Core>
#include <span>

namespace ppm {

/// The surface of a world that is known exactly, to measure maps against; world frame, m. Immutable: any thread may ask.
class TrueSurface {
 public:
  virtual ~TrueSurface() = default;
  /// How far rays from one point go until they meet it. direction: [n] unit, neighbours in space one after the other;
  /// range_m: [n], written; infinity where a ray meets nothing.
  virtual void cast(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3f> direction,
                    std::span<float> range_m) const = 0;
  /// Distance from a point to the nearest surface, on whichever side of it.
  virtual double distance(const Eigen::Vector3d& p) const = 0;
};

}  // namespace ppm
