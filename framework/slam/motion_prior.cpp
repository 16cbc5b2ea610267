#include "framework/slam/motion_prior.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

namespace ppm {

namespace {
constexpr double kFloor = 1e-12;
}  // namespace

Matrix6 MotionPrior::information() const {
  const Matrix6 floored = covariance + kFloor * Matrix6::Identity();
  return floored.llt().solve(Matrix6::Identity());
}

double MotionPrior::log_density(const Pose& T) const {
  const Eigen::LLT<Matrix6> root(covariance + kFloor * Matrix6::Identity());
  const Twist whitened = root.matrixL().solve(offset(T));
  const double log_root = root.matrixLLT().diagonal().array().log().sum();
  return -0.5 * whitened.squaredNorm() - log_root - 3 * std::log(2 * std::numbers::pi);
}

void save(RecordWriter& out, const MotionPrior& prior) {
  out.add(prior.T_map_camera);
  out.add(prior.covariance);
}

void load(RecordReader& in, MotionPrior& prior) {
  in.take(prior.T_map_camera);
  in.take(prior.covariance);
}

}  // namespace ppm
