#pragma once
#include <string>

#include "framework/config/params.hpp"
#include "framework/core/rng.hpp"
#include "framework/core/se3.hpp"
#include "framework/slam/motion_prior.hpp"

namespace ppm {

/// Gaussian noise of a pose: a twist in the camera's own frame whose entries are independent.
struct PoseNoise {
  double sigma_t = 0;  ///< m, along each axis
  double sigma_r = 0;  ///< rad, about each axis

  /// Declares the parameters sigma_t and sigma_r, with the values held as defaults. what: "noise added in each frame".
  void declare(Params& params, const std::string& what);
  /// Of the twist.
  Matrix6 covariance() const;
  /// T_camera_noisy; six draws, translation first.
  Pose draw(Rng rng) const;
};

/// Six independent standard normal draws, in the twist's order.
Twist normal_twist(Rng rng);

}  // namespace ppm
