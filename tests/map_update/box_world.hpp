#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "framework/core/rng.hpp"
#include "framework/slam/frame.hpp"

namespace ppm::test {

/// A world of axis-parallel boxes inside a room, with exact depth images.
struct BoxWorld {
  Eigen::AlignedBox3d room{Eigen::Vector3d(-2, -1.2, -1), Eigen::Vector3d(2, 1.2, 3)};
  std::vector<Eigen::AlignedBox3d> boxes;

  /// Distance along a unit ray to the first surface; from inside the room always finite.
  double distance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    double nearest = slab(room, origin, direction).second;
    for (const auto& box : boxes) {
      const auto [in, out] = slab(box, origin, direction);
      if (in < out && in > 0) nearest = std::min(nearest, in);
    }
    return nearest;
  }

  Frame frame(const Camera& camera, const Pose& T_world_camera, double sigma, std::uint32_t index, bool noisy) const {
    Frame f;
    f.index = index;
    f.camera = camera;
    f.T_world_camera_ref = T_world_camera;
    Rng rng(3, index, 0, purpose_key("depth"));
    for (int y = 0; y < camera.rows; ++y)
      for (int x = 0; x < camera.cols; ++x) {
        const Eigen::Vector3d ray = camera.ray(x, y);
        const double range = distance(T_world_camera.translation(), (T_world_camera.linear() * ray).normalized());
        f.depth.push_back(static_cast<float>(range / ray.norm() + (noisy ? sigma * rng.normal() : 0)));
        f.sigma.push_back(static_cast<float>(sigma));
      }
    return f;
  }

 private:
  static std::pair<double, double> slab(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& o,
                                        const Eigen::Vector3d& d) {
    double in = -std::numeric_limits<double>::infinity(), out = -in;
    for (int k = 0; k < 3; ++k) {
      if (std::abs(d[k]) < 1e-12) continue;
      const double a = (box.min()[k] - o[k]) / d[k], b = (box.max()[k] - o[k]) / d[k];
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    return {in, out};
  }
};

inline Camera small_camera() {
  Camera c;
  c.cols = 80;
  c.rows = 60;
  c.fx = c.fy = 70;
  c.cx = 39.5;
  c.cy = 29.5;
  return c;
}

/// At `position`, looking along +z, turned by yaw (to the right) and pitch, rad.
inline Pose look(const Eigen::Vector3d& position, double yaw = 0, double pitch = 0) {
  Pose T = Pose::Identity();
  T.translate(position);
  T.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitX()));
  return T;
}

}  // namespace ppm::test
