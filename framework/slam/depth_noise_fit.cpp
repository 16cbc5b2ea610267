#include "framework/slam/depth_noise_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

constexpr double kUniform = 1.0 / 10;  // 1/m
constexpr std::size_t kLeast = 500;
constexpr int kIterations = 60;
constexpr double kNearMost_m = 2;

double normal_density(double x, double variance) {
  return std::exp(-0.5 * x * x / variance) / std::sqrt(2 * std::numbers::pi * variance);
}

/// log floor, log quadratic, near, log lateral.
DepthNoise noise_at(const Eigen::Vector4d& x) {
  return {std::exp(x[0]), std::exp(x[1]), x[2], std::exp(x[3])};
}

Eigen::Vector4d bounded(Eigen::Vector4d x) {
  x[0] = std::clamp(x[0], std::log(1e-5), std::log(0.5));
  x[1] = std::clamp(x[1], std::log(1e-6), std::log(0.5));
  x[2] = std::clamp(x[2], 0.0, kNearMost_m);
  x[3] = std::clamp(x[3], std::log(1e-3), std::log(10.0));
  return x;
}

/// Of the logarithm of the whole variance, by numeric differences.
Eigen::Vector4d log_slope(const DepthResidual& r, const Eigen::Vector4d& x, double variance) {
  constexpr double kStep = 1e-5;
  Eigen::Vector4d out;
  for (Eigen::Index k = 0; k < 4; ++k)
    out[k] = (noise_at(x + kStep * Eigen::Vector4d::Unit(k)).variance(r) + r.map_variance - variance) / (kStep * variance);
  return out;
}

}  // namespace

double DepthNoise::variance(const DepthResidual& r) const {
  const double axial = floor + quadratic * (r.depth_m - near) * (r.depth_m - near), across = lateral_px * r.slope_m_px;
  return axial * axial + across * across;
}

DepthNoiseFit fit_depth_noise(const std::vector<DepthResidual>& residuals, const DepthNoise& start) {
  if (residuals.size() < kLeast)
    throw DataError("the held-out frames", fmt::format("give {} residuals; a fit takes {}", residuals.size(), kLeast));
  Eigen::Vector4d x = bounded({std::log(start.floor), std::log(start.quadratic), start.near, std::log(start.lateral_px)});
  double outliers = 0.05;
  for (int k = 0; k < kIterations; ++k) {
    const DepthNoise noise = noise_at(x);
    Eigen::Matrix4d information = 1e-3 * Eigen::Matrix4d::Identity();
    Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
    double explained = 0;
    for (const auto& r : residuals) {
      const double variance = noise.variance(r) + r.map_variance;
      const double normal = (1 - outliers) * normal_density(r.off_m, variance);
      const double share = normal / (normal + outliers * kUniform);
      const Eigen::Vector4d slope = log_slope(r, x, variance);
      gradient += 0.5 * share * (r.off_m * r.off_m / variance - 1) * slope;
      information += 0.5 * share * slope * slope.transpose();
      explained += share;
    }
    outliers = std::clamp(1 - explained / static_cast<double>(residuals.size()), 1e-6, 0.9);
    x = bounded(x + information.ldlt().solve(gradient).cwiseMax(-0.5).cwiseMin(0.5));
  }
  return {noise_at(x), outliers};
}

NoiseQuality noise_quality(const std::vector<DepthResidual>& residuals, const DepthNoise* noise) {
  NoiseQuality out;
  double inliers = 0;
  for (const auto& r : residuals) {
    const double variance = r.map_variance + (noise ? noise->variance(r) : r.sigma_m * r.sigma_m);
    const double normal = 0.95 * normal_density(r.off_m, variance), uniform = 0.05 * kUniform;
    out.log_density += std::log(normal + uniform);
    if (normal < uniform) continue;
    ++inliers;
    out.within_1_sigma += r.off_m * r.off_m <= variance;
    out.within_2_sigma += r.off_m * r.off_m <= 4 * variance;
  }
  out.log_density /= static_cast<double>(residuals.size());
  out.within_1_sigma /= inliers;
  out.within_2_sigma /= inliers;
  return out;
}

}  // namespace ppm
