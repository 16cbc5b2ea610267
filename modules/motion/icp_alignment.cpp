#include "modules/motion/icp_alignment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace ppm {

namespace {

/// Steps of the levels' grids, in steps of the finest, and widths of their gates, in widths of the finest.
constexpr std::array<int, 3> kCoarser{4, 2, 1};
constexpr std::array<double, 3> kWider{3, 2, 1};

Eigen::Vector3f point(const MeasuredSurface::Level& level, std::size_t i) {
  return {level.x[i], level.y[i], level.z[i]};
}
Eigen::Vector3f normal(const MeasuredSurface::Level& level, std::size_t i) {
  return {level.nx[i], level.ny[i], level.nz[i]};
}

/// Of the depth along a normal of the camera's frame, m^2.
float variance_along(const MeasuredSurface::Level& level, std::size_t i, const Eigen::Vector3f& n) {
  return level.variance[i] * n.z() * n.z();
}

}  // namespace

void IcpAlignment::declare(Params& params) {
  params.add_choice("error", error_, {{"plane", Error::plane}, {"point", Error::point}})
      .doc("What a pair is to bring to zero: the distance from the tangent plane of the map's point, or from the point.");
  params.add("step", step_fine_)
      .range(1, 64)
      .doc("The finest level takes each n-th pixel of each n-th row of the frame; two coarser ones each 2n-th and 4n-th.");
  params.add("iterations", iterations_).range(1, 1000).doc("Most steps of a level; fewer where they have become small.");
  params.add("depth_jump", jump_)
      .unit("m")
      .range(0, 10)
      .doc("Pixels where the measured depth departs from a plane through its neighbours by more are left out.");
  params.add("distance", distance_)
      .unit("m")
      .range(0.001, 10)
      .doc("Points of the map farther from a measured one than this are no partners; twice and three times this on the coarser levels.");
  params.add("normal_cosine", normal_cosine_)
      .range(-1, 1)
      .doc("Nor are those whose normal is turned away from the measured one by more (cosine).");
  params.add("trim", trim_).range(0, 0.9).doc("Share of the pairs, those that fit worst, that each step leaves out.");
  params.add("model_sigma", model_sigma_)
      .unit("m")
      .range(0, 1)
      .doc("Standard deviation of the map's surface between its points, beside the points' own.");
  params.add("hold_least", hold_least_)
      .range(0, 1)
      .doc(
          "A direction is held by the pairs where moving by 1 m (or turning by 1 m at the points' range) changes the "
          "residuals' mean square by more than this, m^2; others are left to the motion prior. 0: all count as they are.");
  params.add("alpha", alpha_)
      .range(0, 1)
      .above(0)
      .doc("Factor on the information of the pixels, which err together.");
}

void IcpAlignment::begin(const Frame& frame) {
  std::vector<int> steps;
  for (int coarser : kCoarser) steps.push_back(coarser * step_fine_);
  measured_.build(frame, steps, jump_);
}

Alignment IcpAlignment::align(const PointFinder& map, const MotionPrior& prior, const Pose& start, Scratch& scratch) const {
  constexpr double kSmall = 2e-5;  // m and rad: what a further step would not be worth
  const Matrix6 P = prior.information();
  Alignment at;
  at.T_map_camera = start;
  at.information = P;
  for (std::size_t k = 0; k < kCoarser.size(); ++k) {
    const auto& points = measured_.levels[k];
    for (int step = 0; step < iterations_; ++step) {
      pair(points, map, at.T_map_camera, kWider[k] * distance_, scratch);
      trim(scratch);
      AlignmentSum pairs = sum(points, at.T_map_camera, scratch);
      if (hold_least_ > 0) pairs.drop_weak_directions(hold_least_);
      at.information = alpha_ * pairs.H + P;
      at.likelihood = -0.5 * alpha_ * pairs.cost;
      const Twist x = at.information.ldlt().solve(alpha_ * pairs.b - P * prior.offset(at.T_map_camera));
      if (!x.allFinite()) break;
      at.T_map_camera = at.T_map_camera * se3_exp(x);
      if (x.norm() < kSmall) break;
    }
  }
  at.fit = fit(measured_.levels.back(), map, at.T_map_camera);
  return at;
}

void IcpAlignment::pair(const MeasuredSurface::Level& points, const PointFinder& map, const Pose& T_map_camera, double distance,
                        Scratch& scratch) const {
  scratch.pairs.clear();
  const Eigen::Matrix3f R = T_map_camera.linear().cast<float>();
  const Eigen::Vector3f t = T_map_camera.translation().cast<float>();
  const auto reach = static_cast<float>(distance), cosine = static_cast<float>(normal_cosine_);
  const auto model = static_cast<float>(model_sigma_ * model_sigma_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f p = R * point(points, i) + t;
    const auto found = map.nearest(p, R * normal(points, i), reach, cosine);
    if (!found.point) continue;
    const Eigen::Vector3f n = found.point->normal.vector();
    const float off = n.dot(p - found.point->position);
    const float square = error_ == Error::plane ? off * off : found.square;
    const float variance = variance_along(points, i, R.transpose() * n) + model + found.point->variance();
    scratch.pairs.push_back({static_cast<std::uint32_t>(i), found.point, square / variance});
  }
}

void IcpAlignment::trim(Scratch& scratch) const {
  const auto kept = static_cast<std::size_t>(std::ceil((1 - trim_) * static_cast<double>(scratch.pairs.size())));
  if (kept == scratch.pairs.size()) return;
  scratch.squares.clear();
  for (const auto& p : scratch.pairs) scratch.squares.push_back(p.residual_square);
  const auto limit = scratch.squares.begin() + static_cast<std::ptrdiff_t>(kept);
  std::ranges::nth_element(scratch.squares, limit);
  std::erase_if(scratch.pairs, [least = *limit](const Pair& p) { return p.residual_square >= least; });
}

AlignmentSum IcpAlignment::sum(const MeasuredSurface::Level& points, const Pose& T_map_camera, const Scratch& scratch) const {
  using Rows3 = Eigen::Matrix<double, 3, 6>;
  const Pose T_camera_map = T_map_camera.inverse();
  const double model = model_sigma_ * model_sigma_;
  AlignmentSum sum;
  sum.points = points.size();
  for (const auto& [i, partner, square] : scratch.pairs) {
    const Eigen::Vector3d p = point(points, i).cast<double>();
    const Eigen::Vector3d off = p - T_camera_map * partner->position.cast<double>();
    const Eigen::Vector3d n = T_camera_map.linear() * partner->normal.vector().cast<double>();
    const double weight = 1 / (variance_along(points, i, n.cast<float>()) + model + partner->variance());
    if (error_ == Error::plane) {
      Twist J;
      J << n, p.cross(n);
      sum.H += weight * J * J.transpose();
      sum.b -= weight * n.dot(off) * J;
    } else {
      Rows3 J;
      J.leftCols<3>().setIdentity();
      J.rightCols<3>() << 0, p.z(), -p.y(), -p.z(), 0, p.x(), p.y(), -p.x(), 0;
      sum.H += weight * J.transpose() * J;
      sum.b -= weight * J.transpose() * off;
    }
    sum.cost += square;
    sum.weight += weight;
    sum.squared_range += weight * p.squaredNorm();
  }
  sum.seen = sum.inliers = scratch.pairs.size();
  return sum;
}

AlignmentFit IcpAlignment::fit(const MeasuredSurface::Level& points, const PointFinder& map, const Pose& T_map_camera) const {
  const Eigen::Matrix3f R = T_map_camera.linear().cast<float>();
  const Eigen::Vector3f t = T_map_camera.translation().cast<float>();
  AlignmentFit fit;
  fit.points = points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f p = R * point(points, i) + t;
    const auto found = map.nearest(p, Eigen::Vector3f::Zero(), static_cast<float>(kWider.front() * distance_), -1);
    if (!found.point) continue;
    ++fit.seen;
    const Eigen::Vector3f n = found.point->normal.vector();
    const float off = n.dot(p - found.point->position);
    fit.outliers += std::abs(off) > 3 * std::sqrt(points.variance[i]) + 0.01f;
  }
  return fit;
}

}  // namespace ppm
