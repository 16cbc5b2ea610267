#include "framework/roles/pose_noise.hpp"

#include <numbers>

namespace ppm {

void PoseNoise::declare(Params& params, const std::string& what) {
  params.add("sigma_t", sigma_t)
      .unit("m")
      .range(0, 10)
      .doc(fmt::format("Standard deviation of the translation {}, along each axis of the camera.", what));
  params.add("sigma_r", sigma_r)
      .unit("rad")
      .range(0, std::numbers::pi)
      .doc(fmt::format("Standard deviation of the rotation {}, about each axis of the camera.", what));
}

Matrix6 PoseNoise::covariance() const {
  Twist sigma;
  sigma << Eigen::Vector3d::Constant(sigma_t), Eigen::Vector3d::Constant(sigma_r);
  return sigma.array().square().matrix().asDiagonal();
}

Pose PoseNoise::draw(Rng rng) const {
  Twist xi = normal_twist(rng);
  xi.head<3>() *= sigma_t;
  xi.tail<3>() *= sigma_r;
  return se3_exp(xi);
}

Twist normal_twist(Rng rng) {
  Twist z;
  for (int k = 0; k < 6; ++k) z[k] = rng.normal();
  return z;
}

}  // namespace ppm
