#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace ppm {

/// A unit vector in four bytes, to about 5e-5 rad: its place on an octahedron that is unfolded onto a square.
/// Source: Meyer, Suessmuth, Sussner, Stamminger, Greiner, "On floating-point normal vectors", EGSR 2010.
class UnitNormal {
 public:
  UnitNormal() = default;
  /// n: not zero.
  explicit UnitNormal(const Eigen::Vector3f& n) {
    const float scale = 1.0f / n.cwiseAbs().sum();
    float u = n.x() * scale, v = n.y() * scale;
    if (n.z() < 0) {
      const float folded = (1 - std::abs(v)) * sign(u);
      v = (1 - std::abs(u)) * sign(v);
      u = folded;
    }
    at_ = {round(u), round(v)};
  }
  Eigen::Vector3f vector() const {
    float u = static_cast<float>(at_[0]) / kSteps, v = static_cast<float>(at_[1]) / kSteps;
    const float z = 1 - std::abs(u) - std::abs(v);
    if (z < 0) {
      const float unfolded = (1 - std::abs(v)) * sign(u);
      v = (1 - std::abs(u)) * sign(v);
      u = unfolded;
    }
    return Eigen::Vector3f(u, v, z).normalized();
  }

 private:
  static constexpr float kSteps = 32767;
  static float sign(float x) { return x < 0 ? -1.0f : 1.0f; }
  static std::int16_t round(float x) {
    return static_cast<std::int16_t>(std::lround(std::clamp(x, -1.0f, 1.0f) * kSteps));
  }
  std::array<std::int16_t, 2> at_{0, 0};
};

}  // namespace ppm
