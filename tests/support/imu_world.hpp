#pragma once
#include <cmath>
#include <vector>

#include "framework/core/rng.hpp"
#include "framework/core/so3.hpp"
#include "framework/slam/imu_filter.hpp"

namespace ppm::test {

/// A body that swings along and about all axes, known exactly at any time, z of the world upwards.
struct SwingingBody {
  double speed = 1;  ///< of time

  Eigen::Vector3d position(double s) const {
    const double t = speed * s;
    return {0.8 * std::sin(0.7 * t), 0.5 * std::sin(1.1 * t + 1), 0.2 * std::sin(1.7 * t)};
  }
  Eigen::Vector3d velocity(double s) const {
    const double t = speed * s;
    return speed * Eigen::Vector3d(0.56 * std::cos(0.7 * t), 0.55 * std::cos(1.1 * t + 1), 0.34 * std::cos(1.7 * t));
  }
  Eigen::Vector3d acceleration(double s) const {
    const double t = speed * s;
    return -speed * speed *
           Eigen::Vector3d(0.392 * std::sin(0.7 * t), 0.605 * std::sin(1.1 * t + 1), 0.578 * std::sin(1.7 * t));
  }
  Eigen::Matrix3d rotation(double s) const {
    const double t = speed * s;
    return so3_exp({0, 0, 0.9 * std::sin(0.5 * t)}) * so3_exp({0, 0.4 * std::sin(0.8 * t), 0}) *
           so3_exp({0.3 * std::sin(1.3 * t + 2), 0, 0});
  }
  Pose pose(double s) const {
    Pose T = Pose::Identity();
    T.linear() = rotation(s);
    T.translation() = position(s);
    return T;
  }
  /// By central difference: exact to about 1e-10 rad/s.
  Eigen::Vector3d rate(double s) const {
    constexpr double h = 1e-5;
    Pose T = Pose::Identity();
    T.linear() = rotation(s - h).transpose() * rotation(s + h);
    return se3_log(T).tail<3>() / (2 * h);
  }
  static Eigen::Vector3d gravity() { return {0, 0, -ImuFilter::kGravity}; }
  /// What a perfect inertial unit measures.
  ImuSample sample(double s) const {
    return {s, rate(s), rotation(s).transpose() * (acceleration(s) - gravity())};
  }
  /// Later than begin_s up to end_s, every step_s from the whole multiples of it.
  std::vector<ImuSample> samples(double begin_s, double end_s, double step_s) const {
    std::vector<ImuSample> out;
    for (auto k = static_cast<std::int64_t>(std::floor(begin_s / step_s + 1e-6)) + 1;; ++k) {
      const double s = static_cast<double>(k) * step_s;
      if (s > end_s + 1e-9) return out;
      out.push_back(sample(std::min(s, end_s)));
    }
  }
};

inline Eigen::Vector3d normal3(Rng& rng, double sigma) {
  Eigen::Vector3d v;
  for (int a = 0; a < 3; ++a) v[a] = sigma * rng.normal();
  return v;
}

/// An inertial unit with noise: biases walk from sample to sample, white noise is that of the mean over a step.
struct NoisyImu {
  ImuNoise noise;
  ImuBias bias;
  Rng rng;

  ImuSample measure(ImuSample exact, double step_s) {
    bias.gyro += normal3(rng, noise.gyro_walk * std::sqrt(step_s));
    bias.accel += normal3(rng, noise.accel_walk * std::sqrt(step_s));
    exact.gyro += bias.gyro + normal3(rng, noise.gyro / std::sqrt(step_s));
    exact.accel += bias.accel + normal3(rng, noise.accel / std::sqrt(step_s));
    return exact;
  }
};

}  // namespace ppm::test
