#include "framework/roles/motion_model.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

/// A draw from N(0, covariance), which may be singular.
Twist draw(const Matrix6& covariance, Rng rng) {
  const Eigen::LDLT<Matrix6> root(covariance);
  Twist z = normal_twist(rng);
  z.array() *= root.vectorD().array().max(0.0).sqrt();
  return root.transpositionsP().transpose() * (root.matrixL() * z);
}

}  // namespace

std::optional<PathVelocity> last_velocity(const Trajectory& path) {
  const Trajectory before = path.parent();
  if (before.empty()) return {};
  const double step_s = path.last().stamp_s - before.last().stamp_s;
  if (!(step_s > 0)) return {};
  return PathVelocity{se3_log(before.last().T_map_camera.inverse() * path.last().T_map_camera) / step_s, step_s};
}

void MotionModel::tick(Context& context) {
  const auto now = frame.get();
  auto& particles = *belief;
  for (const auto& path : particles.trajectory) PPM_CHECK(!path.empty(), "the first frame must have begun the path");
  if (particles.trajectory.front().last().frame == now->index) return begin(context);
  auto& priors = particles.column<MotionPrior>(kMotionPriorColumn);
  before(context);
  context.workers().for_each(particles.size(), [&](std::size_t i, int) {
    priors[i] = expect(i, particles.trajectory[i], *now);
    const Pose drawn = priors[i].T_map_camera * se3_exp(draw(priors[i].covariance, context.rng("noise", i)));
    particles.extend(i, {now->index, now->stamp_s, drawn});
  });
}

PathMotion::PathMotion(const PoseNoise& noise) : noise_(noise) {
  noise_.declare(params_, "noise added in each frame");
  params_.add("noise_rate", noise_rate_hz_)
      .unit("Hz")
      .range(0, 1e6)
      .doc(
          "Rate whose steps sigma_t and sigma_r are of: they grow with a step's length, as a velocity that is "
          "uncertain makes them, so that the same numbers do for cameras of any rate. 0 Hz: they are of every step, whatever "
          "its length.");
  params_.add("noise_steps", noise_steps_)
      .range(0, 1000)
      .doc(
          "Learns the noise from how far the model missed the last so many steps of the particle's own path; 0 takes "
          "sigma_t and sigma_r as they are.");
  params_.add("noise_prior", noise_prior_)
      .range(0.01, 1000)
      .doc("Number of steps that sigma_t and sigma_r count for where the noise is learnt.");
  params_.add("noise_scale", noise_scale_)
      .range(0.01, 100)
      .doc("Factor on learnt standard deviations: above 1 to look beyond what has been met.");
}

MotionPrior PathMotion::expect(std::size_t, const Trajectory& path, const Frame& now) {
  const PoseNoise noise = noise_steps_ > 0 ? learnt(path) : noise_;
  const double grown = growth(now.stamp_s - path.last().stamp_s);
  return {predict(path, now.stamp_s), PoseNoise{grown * noise.sigma_t, grown * noise.sigma_r}.covariance()};
}

double PathMotion::growth(double step_s) const {
  return noise_rate_hz_ > 0 ? std::max(step_s, 0.0) * noise_rate_hz_ : 1;
}

PoseNoise PathMotion::learnt(const Trajectory& path) const {
  double t = noise_prior_ * noise_.sigma_t * noise_.sigma_t, r = noise_prior_ * noise_.sigma_r * noise_.sigma_r;
  double weight = noise_prior_;
  Trajectory at = path;
  // A path's first step is a start from rest: no model foresees it.
  for (int k = 0; k < noise_steps_ && at.length() > 2; ++k) {
    const Trajectory before = at.parent();
    const double grown = growth(at.last().stamp_s - before.last().stamp_s);
    const Twist e = se3_log(predict(before, at.last().stamp_s).inverse() * at.last().T_map_camera) / std::max(grown, 1e-6);
    t += e.head<3>().squaredNorm() / 3;
    r += e.tail<3>().squaredNorm() / 3;
    weight += 1;
    at = before;
  }
  // A path that jumped (lost, found again) is no measure of the next step.
  constexpr double kMost = 10;
  return {noise_scale_ * std::min(std::sqrt(t / weight), kMost * noise_.sigma_t),
          noise_scale_ * std::min(std::sqrt(r / weight), kMost * noise_.sigma_r)};
}

}  // namespace ppm
