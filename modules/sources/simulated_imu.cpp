#include "modules/sources/simulated_imu.hpp"

#include <cmath>

#include "framework/core/rng.hpp"

namespace ppm {
namespace {

Eigen::Vector3d normals(Rng& rng) {
  const double x = rng.normal(), y = rng.normal(), z = rng.normal();
  return {x, y, z};
}

}  // namespace

std::vector<ImuSample> SimulatedImu::samples(const CameraPath& path, double until_s, std::uint64_t seed) const {
  const std::uint32_t start = purpose_key("simulated_imu/start"), step = purpose_key("simulated_imu/step");
  const double white = std::sqrt(rate_Hz), walk = std::sqrt(1 / rate_Hz);
  Rng begin(seed, 0, 0, start);
  Eigen::Vector3d gyro_offset = gyro_bias * normals(begin), accel_offset = accel_bias * normals(begin);
  std::vector<ImuSample> out;
  const auto first = -static_cast<std::int64_t>(std::floor(kBefore_s * rate_Hz));
  for (std::int64_t k = first; static_cast<double>(k) / rate_Hz <= until_s; ++k) {
    const double t = static_cast<double>(k) / rate_Hz;
    const CameraMotion m = path.at(t);
    Rng rng(seed, static_cast<std::uint32_t>(k - first), 0, step);
    ImuSample sample;
    sample.stamp_s = t;
    sample.gyro = m.angular_velocity + gyro_offset + gyro_noise * white * normals(rng);
    const Eigen::Vector3d force = m.acceleration_world + kGravity * Eigen::Vector3d::UnitZ();
    sample.accel = m.T_world_camera.linear().transpose() * force + accel_offset + accel_noise * white * normals(rng);
    out.push_back(sample);
    gyro_offset += gyro_walk * walk * normals(rng);
    accel_offset += accel_walk * walk * normals(rng);
  }
  return out;
}

}  // namespace ppm
