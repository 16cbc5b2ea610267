#include "framework/slam/view_alignment.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace ppm {

namespace {

constexpr float kMinSlope = 0.2f;  // least |normal . ray| that is divided by, see Prediction::kMinCosine

/// How far a point is from a surface's tangent plane, along its own ray: a slanted surface is no error where the pixel's
/// centre is not met exactly. Per unit of depth.
float off_plane(const SurfaceView::Texel& s, const Eigen::Vector3f& q) {
  const Eigen::Vector3f n(s.nx, s.ny, s.nz);
  const float slope = std::max(std::abs(n.dot(q)) / q.z(), kMinSlope);
  return std::abs(n.dot(q - Eigen::Vector3f(s.x, s.y, s.z))) / slope;
}

/// Points of the frame in the view's camera, and the surface where each is seen.
class Association {
 public:
  Association(const SurfaceView& view, const Pose& T_map_camera) : view_(view), camera_(view.camera) {
    const Pose T_view_camera = view.T_map_camera.inverse() * T_map_camera;
    R = T_view_camera.linear().cast<float>();
    t = T_view_camera.translation().cast<float>();
    fx_ = static_cast<float>(camera_.fx), fy_ = static_cast<float>(camera_.fy);
    cx_ = static_cast<float>(camera_.cx), cy_ = static_cast<float>(camera_.cy);
  }
  /// The surface at the pixel that a point of the view's camera frame falls onto, or null.
  const SurfaceView::Texel* at(const Eigen::Vector3f& q) const {
    if (!(q.z() > 0.05f)) return nullptr;
    const float w = 1.0f / q.z();
    const float col = std::floor(fx_ * q.x() * w + cx_ + 0.5f), row = std::floor(fy_ * q.y() * w + cy_ + 0.5f);
    if (!(col >= 0 && row >= 0 && col < static_cast<float>(camera_.cols) && row < static_cast<float>(camera_.rows)))
      return nullptr;
    const auto& texel =
        view_.texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.cols) + static_cast<std::size_t>(col)];
    return texel.hit > 0 ? &texel : nullptr;
  }
  /// Whether one of the pixels around a surface's own shows one that fits the point: at the edges of things the pixel that
  /// a point falls onto is a matter of chance.
  bool near_fits(const SurfaceView::Texel* own, const Eigen::Vector3f& q, float tolerance) const {
    const auto at = static_cast<int>(own - view_.texels.data()), col = at % camera_.cols, row = at / camera_.cols;
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, camera_.rows - 1); ++y)
      for (int x = std::max(col - 1, 0); x <= std::min(col + 1, camera_.cols - 1); ++x) {
        const auto& s = view_.texels[static_cast<std::size_t>(y * camera_.cols + x)];
        if (s.hit > 0 && off_plane(s, q) < tolerance) return true;
      }
    return false;
  }
  Eigen::Matrix3f R;
  Eigen::Vector3f t;

 private:
  const SurfaceView& view_;
  const Camera& camera_;
  float fx_, fy_, cx_, cy_;
};

/// The upper triangle of H, b and the cost, summed in single precision over a short run of points and then in double.
struct Run {
  static constexpr std::size_t kPoints = 256;
  float h[21] = {}, b[6] = {}, cost = 0, weights = 0, range2 = 0;

  void add(const float* J, float r, float weight, float squared_range) {
    int k = 0;
    for (int i = 0; i < 6; ++i) {
      const float wj = weight * J[i];
      for (int j = i; j < 6; ++j) h[k++] += wj * J[j];
      b[i] -= wj * r;
    }
    cost += weight * r * r;
    weights += weight;
    range2 += weight * squared_range;
  }
  void flush(AlignmentSum& sum) {
    int k = 0;
    for (int i = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j) sum.H(i, j) += static_cast<double>(h[k++]);
      sum.b[i] += static_cast<double>(b[i]);
    }
    sum.cost += static_cast<double>(cost);
    sum.weight += static_cast<double>(weights);
    sum.squared_range += static_cast<double>(range2);
    *this = {};
  }
};

}  // namespace

AlignmentSum align_sum(const MeasuredSurface::Level& level, const SurfaceView& view, const Pose& T_map_camera,
                       const AlignmentGate& gate) {
  const Association association(view, T_map_camera);
  const Eigen::Matrix3f R_camera_view = association.R.transpose();
  const auto distance = static_cast<float>(gate.distance_m), cosine = static_cast<float>(gate.normal_cosine);
  const auto model = static_cast<float>(gate.model_sigma_m * gate.model_sigma_m);
  const float cauchy = gate.cauchy > 0 ? static_cast<float>(1 / (gate.cauchy * gate.cauchy)) : 0.0f;
  AlignmentSum sum;
  sum.points = level.size();
  Run run;
  for (std::size_t i = 0; i < level.size(); ++i) {
    if (i % Run::kPoints == 0) run.flush(sum);
    const Eigen::Vector3f p(level.x[i], level.y[i], level.z[i]);
    const Eigen::Vector3f q = association.R * p + association.t;
    const auto* s = association.at(q);
    if (!s) continue;
    ++sum.seen;
    const Eigen::Vector3f normal(s->nx, s->ny, s->nz);
    const float r = normal.dot(q - Eigen::Vector3f(s->x, s->y, s->z));
    if (!(std::abs(r) < distance)) continue;
    const Eigen::Vector3f n = R_camera_view * normal;
    const Eigen::Vector3f measured(level.nx[i], level.ny[i], level.nz[i]);
    // A point without a normal is taken by its distance alone.
    if (measured.squaredNorm() > 0 && n.dot(measured) < cosine) continue;
    ++sum.inliers;
    float weight = 1.0f / (level.variance[i] * n.z() * n.z() + model + s->variance);
    weight /= 1.0f + cauchy * weight * r * r;
    const Eigen::Vector3f arm = p.cross(n);
    const float J[6] = {n.x(), n.y(), n.z(), arm.x(), arm.y(), arm.z()};
    run.add(J, r, weight, p.squaredNorm());
  }
  run.flush(sum);
  sum.H.triangularView<Eigen::StrictlyLower>() = sum.H.transpose();
  return sum;
}

void AlignmentSum::drop_weak_directions(double least) {
  if (!(weight > 0)) return;
  const double range = std::sqrt(squared_range / weight);
  Twist scale = Twist::Ones();
  scale.tail<3>().setConstant(1 / range);
  const Eigen::SelfAdjointEigenSolver<Matrix6> directions(scale.asDiagonal() * H * scale.asDiagonal());
  const Twist kept = (directions.eigenvalues() / (weight * least) - Twist::Ones()).cwiseMax(0.0).cwiseMin(1.0);
  const Matrix6 V = scale.cwiseInverse().asDiagonal() * directions.eigenvectors();
  b = V * kept.asDiagonal() * directions.eigenvectors().transpose() * scale.asDiagonal() * b;
  H = V * kept.cwiseProduct(directions.eigenvalues()).asDiagonal() * V.transpose();
}

AlignmentFit alignment_fit(const MeasuredSurface::Level& level, const SurfaceView& view, const Pose& T_map_camera) {
  const Association association(view, T_map_camera);
  AlignmentFit fit;
  fit.points = level.size();
  for (std::size_t i = 0; i < level.size(); ++i) {
    const Eigen::Vector3f q = association.R * Eigen::Vector3f(level.x[i], level.y[i], level.z[i]) + association.t;
    const auto* s = association.at(q);
    if (!s) continue;
    ++fit.seen;
    const float tolerance = 3 * std::sqrt(level.variance[i]) + 0.01f;
    fit.outliers += !(off_plane(*s, q) < tolerance) && !association.near_fits(s, q, tolerance);
  }
  return fit;
}

}  // namespace ppm
