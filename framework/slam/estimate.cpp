#include "framework/slam/estimate.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

std::vector<double> weights_of(const ParticleSet& belief) {
  std::vector<double> weights;
  weights.reserve(belief.size());
  for (double l : belief.log_weight) weights.push_back(std::exp(l));
  return weights;
}

/// log(T_center^-1 T_i) of each particle.
std::vector<Twist> offsets(const ParticleSet& belief, const Pose& center) {
  std::vector<Twist> out;
  out.reserve(belief.size());
  const Pose inverse = center.inverse();
  for (const auto& T : belief.pose) out.push_back(se3_log(inverse * T));
  return out;
}

Spread spread_about(const ParticleSet& belief, const Pose& mean) {
  Spread sum;
  const auto weights = weights_of(belief);
  for (std::size_t i = 0; i < belief.size(); ++i) {
    const Pose off = mean.inverse() * belief.pose[i];
    sum.translation_m += weights[i] * off.translation().squaredNorm();
    sum.rotation_rad += weights[i] * std::pow(rotation_angle(off), 2);
  }
  return {std::sqrt(sum.translation_m), std::sqrt(sum.rotation_rad)};
}

/// Gaussian kernels about points whose axes are in units of the kernel's width.
class KernelDensity {
 public:
  KernelDensity(std::vector<Twist> points, std::vector<double> weights)
      : points_(std::move(points)), weights_(std::move(weights)) {}

  const Twist& densest_point() const {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      double density = 0;
      for (std::size_t j = 0; j < points_.size(); ++j) density += share(j, points_[i]);
      if (density > most) {
        most = density;
        best = i;
      }
    }
    return points_[best];
  }
  /// One step of mean shift.
  Twist uphill(const Twist& from) const {
    Twist sum = Twist::Zero();
    double total = 0;
    for (std::size_t j = 0; j < points_.size(); ++j) {
      const double w = share(j, from);
      sum += w * points_[j];
      total += w;
    }
    return sum / total;
  }

 private:
  double share(std::size_t j, const Twist& at) const {
    return weights_[j] * std::exp(-0.5 * (points_[j] - at).squaredNorm());
  }
  std::vector<Twist> points_;
  std::vector<double> weights_;
};

/// Silverman's rule in 6 dimensions, in standard deviations of one axis.
double kernel_width(double effective_points) {
  constexpr double kDimensions = 6;
  return std::pow(4 / ((kDimensions + 2) * effective_points), 1 / (kDimensions + 4));
}

}  // namespace

const std::vector<std::pair<std::string, Estimate>>& estimate_names() {
  static const std::vector<std::pair<std::string, Estimate>> names{
      {"best", Estimate::best}, {"mean", Estimate::mean}, {"mode", Estimate::mode}};
  return names;
}

std::string to_string(Estimate estimate) {
  const auto& names = estimate_names();
  return std::ranges::find(names, estimate, [](const auto& n) { return n.second; })->first;
}

Pose mean_pose(const ParticleSet& belief) {
  const auto weights = weights_of(belief);
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < belief.size(); ++i) sum += weights[i] * belief.pose[i].matrix();
  return orthonormalized(sum);
}

Spread spread(const ParticleSet& belief) {
  return spread_about(belief, mean_pose(belief));
}

Pose mode_pose(const ParticleSet& belief) {
  const Pose mean = mean_pose(belief);
  const Spread s = spread_about(belief, mean);
  const double h = kernel_width(belief.ess()) / std::sqrt(3.0);
  // Particles that agree have no width: any will do.
  const double h_t = std::max(h * s.translation_m, 1e-9), h_r = std::max(h * s.rotation_rad, 1e-9);
  Twist width;
  width << h_t, h_t, h_t, h_r, h_r, h_r;
  auto points = offsets(belief, mean);
  for (auto& p : points) p = p.cwiseQuotient(width);
  const KernelDensity density(std::move(points), weights_of(belief));
  Twist top = density.densest_point();
  constexpr int kMostSteps = 100;
  constexpr double kArrived = 1e-4;  // kernel widths
  for (int k = 0; k < kMostSteps; ++k) {
    const Twist next = density.uphill(top);
    const double step = (next - top).norm();
    top = next;
    if (step < kArrived) break;
  }
  return mean * se3_exp(top.cwiseProduct(width));
}

Pose estimate_pose(const ParticleSet& belief, Estimate estimate) {
  PPM_CHECK(belief.size() > 0, "no particle to estimate a pose from");
  switch (estimate) {
    case Estimate::best:
      return belief.pose[belief.best()];
    case Estimate::mean:
      return mean_pose(belief);
    case Estimate::mode:
      return mode_pose(belief);
  }
  PPM_CHECK(false, "estimate {}", static_cast<int>(estimate));
}

}  // namespace ppm
