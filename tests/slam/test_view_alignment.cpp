#include <catch2/catch.hpp>
#include <Eigen/Eigenvalues>

#include "framework/slam/view_alignment.hpp"
#include "tests/support/plane_image.hpp"

namespace {

using namespace ppm;

Camera camera() {
  return {80, 60, 70, 70, 39.5, 29.5};
}

/// The view of a plane normal . p = offset at the identity.
SurfaceView plane_view(const Eigen::Vector3d& normal, double offset, float variance = 1e-6f) {
  SurfaceView view;
  view.camera = camera();
  const Eigen::Vector3f n = (offset > 0 ? -normal : normal).normalized().cast<float>();
  for (int y = 0; y < view.camera.rows; ++y)
    for (int x = 0; x < view.camera.cols; ++x) {
      const Eigen::Vector3d ray = view.camera.ray(x, y);
      const Eigen::Vector3f p = (offset / normal.dot(ray) * ray).cast<float>();
      view.texels.push_back({p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), variance, 1});
    }
  return view;
}

MeasuredSurface::Level measured(const Eigen::Vector3d& normal, double offset) {
  MeasuredSurface surface;
  surface.build(test::plane_image(camera(), normal, offset), {1}, 0.05);
  return surface.levels.front();
}

const Eigen::Vector3d kSlanted = Eigen::Vector3d(0.3, -0.2, 1).normalized();

Twist twist(double tx, double ty, double tz, double rx, double ry, double rz) {
  Twist xi;
  xi << tx, ty, tz, rx, ry, rz;
  return xi;
}

}  // namespace

TEST_CASE("the sums of an alignment are the derivatives of its cost") {
  const auto view = plane_view(kSlanted, 1.5);
  const auto level = measured(kSlanted, 1.5);
  const AlignmentGate gate{0.2, 0.5, 0, 0.001};
  const Pose T = se3_exp(twist(0.01, -0.005, 0.012, 0.01, -0.012, 0.008));
  const auto sum = align_sum(level, view, T, gate);
  REQUIRE(sum.inliers > 2000);
  CHECK(sum.H.isApprox(sum.H.transpose()));
  // Of the same points: with weights that hardly change the cost's slope is -2 b, its bend 2 H.
  for (int k = 0; k < 6; ++k) {
    Twist step = Twist::Zero();
    step[k] = 1e-4;
    const auto more = align_sum(level, view, T * se3_exp(step), gate), less = align_sum(level, view, T * se3_exp(-step), gate);
    if (more.inliers != sum.inliers || less.inliers != sum.inliers) continue;
    const double slope = (more.cost - less.cost) / 2e-4;
    CHECK(slope == Approx(-2 * sum.b[k]).epsilon(0.05).margin(0.02 * sum.b.norm()));
  }
}

TEST_CASE("a plane holds three directions and leaves three") {
  const auto view = plane_view({0, 0, 1}, 1.5);
  auto sum = align_sum(measured({0, 0, 1}, 1.5), view, se3_exp(twist(0, 0, 0.01, 0, 0, 0)), {});
  sum.drop_weak_directions(0.001);
  const Eigen::SelfAdjointEigenSolver<Matrix6> directions(sum.H);
  int held = 0;
  for (double value : directions.eigenvalues()) held += value > 1e-6 * directions.eigenvalues().maxCoeff();
  CHECK(held == 3);
  // Towards and away from the plane, and the two turns that tilt it.
  for (int free : {0, 1, 5}) CHECK(sum.H(free, free) < 1e-6 * sum.H(2, 2));
  CHECK(sum.b[2] < 0);
}

TEST_CASE("what is held well is not touched") {
  AlignmentSum sum;
  sum.H = 2.0 * Matrix6::Identity();
  sum.b = Twist::Ones();
  sum.weight = 1;
  sum.squared_range = 1;
  auto kept = sum;
  kept.drop_weak_directions(0.5);
  CHECK(kept.H.isApprox(sum.H));
  CHECK(kept.b.isApprox(sum.b));
  sum.H(0, 0) = 0.75;  // half way between the bound and twice that
  kept = sum;
  kept.drop_weak_directions(0.5);
  CHECK(kept.H(0, 0) == Approx(0.375));
  CHECK(kept.b[0] == Approx(0.5));
  CHECK(kept.H(1, 1) == Approx(2.0));
}

TEST_CASE("a fit counts what lies elsewhere, and not what an edge explains") {
  const auto level = measured({0, 0, 1}, 1.5);
  auto view = plane_view({0, 0, 1}, 1.5);
  CHECK(alignment_fit(level, view, Pose::Identity()).outliers == 0);
  CHECK(alignment_fit(level, view, Pose::Identity()).inlier_share() == 1);
  CHECK(alignment_fit(level, view, Pose(Eigen::Translation3d(0, 0, 0.1))).outlier_share() == 1);
  // A single row of the view that shows something nearer: each of its pixels has a neighbour that fits.
  for (int x = 0; x < view.camera.cols; ++x) view.texels[static_cast<std::size_t>(30 * view.camera.cols + x)].z = 1.0f;
  CHECK(alignment_fit(level, view, Pose::Identity()).outliers == 0);
  // Three rows: the middle one has none.
  for (int row : {29, 31})
    for (int x = 0; x < view.camera.cols; ++x)
      view.texels[static_cast<std::size_t>(row * view.camera.cols + x)].z = 1.0f;
  CHECK(alignment_fit(level, view, Pose::Identity()).outliers == static_cast<std::size_t>(view.camera.cols));
}

TEST_CASE("points far from the surface, or turned away from it, are not aligned") {
  const auto view = plane_view({0, 0, 1}, 1.5);
  const auto level = measured({0, 0, 1}, 1.5);
  CHECK(align_sum(level, view, Pose(Eigen::Translation3d(0, 0, 0.1)), {0.06, 0.85, 0, 0.001}).inliers == 0);
  CHECK(align_sum(level, view, Pose(Eigen::Translation3d(0, 0, 0.1)), {0.2, 0.85, 0, 0.001}).inliers > 4000);
  const auto slanted = measured(Eigen::Vector3d(1, 0, 1).normalized(), 1.5 / std::sqrt(2.0));  // meets it on the axis
  const auto sum = align_sum(slanted, view, Pose::Identity(), {10, 0.85, 0, 0.001});
  CHECK(sum.seen > 4000);
  CHECK(sum.inliers < sum.seen / 3);  // at the rim, and where depth changes fast, points have no normal: distance alone counts
}

TEST_CASE("measured points leave out jumps and what has no return") {
  Frame f = test::plane_image(camera(), {0, 0, 1}, 1.5);
  for (int y = 0; y < f.camera.rows; ++y)
    for (int x = 40; x < f.camera.cols; ++x) f.depth[static_cast<std::size_t>(y * f.camera.cols + x)] = 2.5f;
  f.depth[100] = f.sigma[100] = test::kNoReturn;
  MeasuredSurface surface;
  surface.build(f, {4, 1}, 0.05);
  REQUIRE(surface.levels.size() == 2);
  const auto& fine = surface.levels.back();
  CHECK(surface.measured == static_cast<std::size_t>(f.camera.pixels() - 1));
  CHECK(fine.size() < surface.measured);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const double column = f.camera.project({fine.x[i], fine.y[i], fine.z[i]}).x();
    CHECK(std::abs(column - 39.5) > 0.6);
    if (fine.nz[i] != 0) CHECK(fine.nz[i] == Approx(-1));
  }
  CHECK(surface.levels.front().size() <= 15 * 20);
}
