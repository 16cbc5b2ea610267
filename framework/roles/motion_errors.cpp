#include "framework/roles/motion_errors.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "framework/core/so3.hpp"
#include "framework/core/timing.hpp"
#include "framework/graph/harness.hpp"

namespace ppm {

namespace {

constexpr std::size_t kLeftOut = 2;

MotionError error_of(const MotionPrior& prior, const Frame& before, const Frame& now) {
  MotionError e;
  e.error = prior.offset(*now.T_world_camera_ref);
  e.log_density = prior.log_density(*now.T_world_camera_ref);
  e.body_error = adjoint(now.T_base_camera) * e.error;
  // The floor is that of MotionPrior::log_density.
  e.mahalanobis = e.error.dot((prior.covariance + 1e-12 * Matrix6::Identity()).ldlt().solve(e.error));
  if (before.T_odom_base && now.T_odom_base) e.T_body_step = before.T_odom_base->inverse() * *now.T_odom_base;
  return e;
}

}  // namespace

std::vector<MotionError> motion_errors(const Registry& registry, const std::string& model,
                                       const std::string& params_yaml, const std::vector<Frame>& frames) {
  Harness model_alone(registry, model, params_yaml);
  auto& belief = model_alone.belief();
  belief.init(1, *frames.front().T_world_camera_ref, nullptr);
  std::vector<MotionError> errors;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Frame& now = frames[k];
    if (k == 0) belief.extend(0, {now.index, now.stamp_s, *now.T_world_camera_ref});
    model_alone.input<Frame>("frame", std::make_shared<const Frame>(now));
    model_alone.tick();
    if (k == 0) continue;
    if (k > kLeftOut)
      errors.push_back(error_of(belief.column<MotionPrior>(kMotionPriorColumn)[0], frames[k - 1], now));
    belief.correct(0, *now.T_world_camera_ref);
  }
  return errors;
}

std::vector<Frame> every_nth(const std::vector<Frame>& frames, std::size_t n, std::size_t phase) {
  std::vector<Frame> out;
  std::vector<ImuSample> on_the_way;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    on_the_way.insert(on_the_way.end(), frames[k].imu.begin(), frames[k].imu.end());
    if (k < phase || (k - phase) % n != 0) continue;
    out.push_back(frames[k]);
    if (out.size() > 1) out.back().imu = on_the_way;
    on_the_way.clear();
  }
  return out;
}

MotionErrorSummary summary(const std::vector<MotionError>& errors) {
  MotionErrorSummary out;
  out.steps = errors.size();
  std::vector<double> t, r;
  Twist squares = Twist::Zero();
  for (const auto& e : errors) {
    squares += e.error.cwiseAbs2();
    out.consistency += e.mahalanobis / 6;
    t.push_back(e.error.head<3>().norm());
    r.push_back(e.error.tail<3>().norm());
  }
  const double n = static_cast<double>(errors.size());
  squares /= n;
  out.rms = squares.cwiseSqrt();
  out.sigma_t = std::sqrt(squares.head<3>().mean());
  out.sigma_r = std::sqrt(squares.tail<3>().mean());
  out.translation_95 = quantile(std::move(t), 0.95);
  out.rotation_95 = quantile(std::move(r), 0.95);
  out.consistency /= n;
  return out;
}

GrowingNoise fit_growing_noise(const std::vector<MotionError>& errors, bool rotation) {
  // The mean size of a normal deviate is sqrt(2 / pi) of its deviation.
  const double scale = std::sqrt(std::numbers::pi / 2) / 3;
  Eigen::MatrixX3d A(errors.size(), 3);
  Eigen::VectorXd y(errors.size());
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    A.row(row) << 1, errors[k].T_body_step.translation().norm(), rotation_angle(errors[k].T_body_step);
    y[row] = scale * (rotation ? errors[k].body_error.tail<3>() : errors[k].body_error.head<3>()).cwiseAbs().sum();
  }
  // Least squares with each set of the three kept and the others zero: the best without a negative one.
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (int kept = 1; kept < 8; ++kept) {
    Eigen::MatrixX3d part = A;
    for (int c = 0; c < 3; ++c)
      if (!(kept >> c & 1)) part.col(c).setZero();
    const Eigen::Vector3d x = part.completeOrthogonalDecomposition().solve(y);
    const double left = (part * x - y).squaredNorm();
    if (x.minCoeff() < 0 || !(left < least)) continue;
    least = left;
    best = x;
  }
  return {best[0], best[1], best[2]};
}

Config likeliest(const Registry& registry, const std::string& model, Config params,
                 const std::vector<std::string>& keys, const std::vector<Frame>& frames) {
  const auto likelihood = [&](const Config& some) {
    double sum = 0;
    for (const auto& e : motion_errors(registry, model, some.to_yaml(), frames)) sum += e.log_density;
    return sum;
  };
  constexpr double kLeast = 1e-7;
  double best = likelihood(params);
  for (const double factor : {4.0, 2.0, 1.3, 1.1}) {
    for (bool better = true; better;) {
      better = false;
      for (const auto& key : keys)
        for (const double times : {factor, 1 / factor}) {
          const double value = times * std::stod(params.find(key)->text());
          if (value < kLeast) continue;
          Config changed = params;
          changed.set(key, {}, Config::scalar(fmt::format("{:.6g}", value), {}));
          const double now = likelihood(changed);
          if (!(now > best)) continue;
          best = now;
          params = std::move(changed);
          better = true;
        }
    }
  }
  return params;
}

}  // namespace ppm
