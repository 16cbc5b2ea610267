#pragma once
#include <cstdint>
#include <vector>

#include "framework/slam/frame.hpp"
#include "modules/sources/camera_path.hpp"

namespace ppm {

/// An inertial unit in the axes of a camera that is moved along a path.
///   gyro    angular velocity + bias + white noise
///   accel   R_camera_world * (acceleration - gravity) + bias + white noise; gravity is (0, 0, -9.80665) m/s^2 in the world
/// Biases start with a draw of standard deviation gyro_bias, accel_bias for each axis and walk from there. A path's jump is
/// not felt.
/// Source of the model: Woodman, "An introduction to inertial navigation", UCAM-CL-TR-696, 2007, section 3. Of the figures: white
/// noise of the BMI055 (Bosch, data sheet, 2014), as in many phones and depth cameras; walks of the EuRoC data set's unit
/// (Burri et al., IJRR 35(10), 2016).
struct SimulatedImu {
  double rate_Hz = 200;
  double gyro_noise = 2.4e-4;   ///< rad/s/sqrt(Hz)
  double accel_noise = 1.5e-3;  ///< m/s^2/sqrt(Hz)
  double gyro_walk = 2e-5;      ///< rad/s^2/sqrt(Hz)
  double accel_walk = 3e-3;     ///< m/s^3/sqrt(Hz)
  double gyro_bias = 0.0035;    ///< rad/s
  double accel_bias = 0.05;     ///< m/s^2

  static constexpr double kGravity = 9.80665;  ///< m/s^2
  static constexpr double kBefore_s = 1;       ///< samples begin so long before the path does

  /// Samples from kBefore_s before the path's start to `until_s`. A function of path and seed.
  std::vector<ImuSample> samples(const CameraPath& path, double until_s, std::uint64_t seed) const;
};

}  // namespace ppm
