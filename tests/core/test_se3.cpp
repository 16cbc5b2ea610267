#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/core/rng.hpp"
#include "framework/core/se3.hpp"

using namespace ppm;

namespace {

constexpr double kPi = std::numbers::pi;

Twist random_twist(Rng& rng, double angle) {
  Twist xi;
  for (int i = 0; i < 6; ++i) xi[i] = rng.normal();
  xi.tail<3>() *= angle / xi.tail<3>().norm();
  return xi;
}

/// The matrix exponential of a twist by its power series with scaling and squaring: an oracle without case
/// distinctions.
Eigen::Matrix4d series_exp(const Twist& xi) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  A.topLeftCorner<3, 3>() << 0, -xi[5], xi[4], xi[5], 0, -xi[3], -xi[4], xi[3], 0;
  A.topRightCorner<3, 1>() = xi.head<3>();
  A /= 1024;
  Eigen::Matrix4d term = Eigen::Matrix4d::Identity(), sum = term;
  for (int k = 1; k < 20; ++k) sum += term = term * A / k;
  for (int k = 0; k < 10; ++k) sum = (sum * sum).eval();
  return sum;
}

}  // namespace

TEST_CASE("exp agrees with the power series of the matrix exponential") {
  Rng rng(1, 0, 0, 0);
  for (double angle : {1e-12, 1e-8, 1e-5, 1e-3, 0.05, 0.0999, 0.1001, 0.5, 1.5, 3.0, kPi, 5.0})
    for (int i = 0; i < 20; ++i) {
      const Twist xi = random_twist(rng, angle);
      CAPTURE(angle);
      CHECK((se3_exp(xi).matrix() - series_exp(xi)).cwiseAbs().maxCoeff() < 2e-12);
    }
}

TEST_CASE("log is the inverse of exp for rotations below pi") {
  Rng rng(2, 0, 0, 0);
  for (double angle : {1e-15, 1e-9, 1e-4, 0.0999, 0.1001, 1.0, 2.5, kPi - 1e-3, kPi - 1e-6})
    for (int i = 0; i < 50; ++i) {
      const Twist xi = random_twist(rng, angle);
      CAPTURE(angle);
      CHECK((se3_log(se3_exp(xi)) - xi).cwiseAbs().maxCoeff() < 1e-9);
    }
  CHECK(se3_log(Pose::Identity()).norm() == 0);
  CHECK(se3_exp(Twist::Zero()).matrix() == Pose::Identity().matrix());
}

TEST_CASE("exp of log gives the pose back, also half a turn") {
  Rng rng(3, 0, 0, 0);
  for (int i = 0; i < 200; ++i) {
    const double angle = i < 100 ? kPi : kPi * rng.uniform();
    const Pose T = se3_exp(random_twist(rng, angle));
    CHECK((se3_exp(se3_log(T)).matrix() - T.matrix()).cwiseAbs().maxCoeff() < 1e-7);
  }
}

TEST_CASE("a screw motion in closed form") {
  Twist xi;
  xi << 0, 0, 3, 0, 0, kPi / 2;  // up 3 m with a quarter turn to the left
  const Eigen::Vector3d p = se3_exp(xi) * Eigen::Vector3d(1, 0, 0);
  CHECK((p - Eigen::Vector3d(0, 1, 3)).norm() < 1e-15);
}

TEST_CASE("interpolation: ends, constant turn, the short way round") {
  Rng rng(4, 0, 0, 0);
  const Pose a = se3_exp(random_twist(rng, 1.0)), b = se3_exp(random_twist(rng, 2.0));
  CHECK((interpolate(a, b, 0).matrix() - a.matrix()).norm() < 1e-14);
  CHECK((interpolate(a, b, 1).matrix() - b.matrix()).norm() < 1e-14);
  const double whole = rotation_angle(a.inverse() * b);
  CHECK(rotation_angle(a.inverse() * interpolate(a, b, 0.25)) == Approx(whole / 4).margin(1e-12));
  CHECK((interpolate(a, b, 0.25).translation() - (0.75 * a.translation() + 0.25 * b.translation())).norm() < 1e-14);

  Pose left = Pose::Identity(), right = Pose::Identity();
  left.rotate(Eigen::AngleAxisd(0.9 * kPi, Eigen::Vector3d::UnitZ()));
  right.rotate(Eigen::AngleAxisd(-0.9 * kPi, Eigen::Vector3d::UnitZ()));
  CHECK(rotation_angle(interpolate(left, right, 0.5)) == Approx(kPi).margin(1e-12));
}

TEST_CASE("orthonormalized is the nearest rotation") {
  Rng rng(5, 0, 0, 0);
  for (int i = 0; i < 50; ++i) {
    const Pose T = se3_exp(random_twist(rng, 2.0));
    CHECK((orthonormalized(T.matrix()).matrix() - T.matrix()).norm() < 1e-13);
    // stretched symmetrically, R * S, the polar decomposition gives R back exactly
    Eigen::Matrix3d S = Eigen::Matrix3d::Identity() +
                        0.1 * Eigen::Vector3d(rng.uniform(), rng.uniform(), rng.uniform()).asDiagonal().toDenseMatrix();
    S(0, 1) = S(1, 0) = 0.03;
    Eigen::Matrix4d M = T.matrix();
    M.topLeftCorner<3, 3>() = T.linear() * S;
    const Pose back = orthonormalized(M);
    CHECK((back.matrix() - T.matrix()).norm() < 1e-12);
    CHECK(back.linear().determinant() == Approx(1));
  }
  Eigen::Matrix4d mirrored = Eigen::Matrix4d::Identity();
  mirrored(2, 2) = -0.5;
  CHECK(orthonormalized(mirrored).linear().determinant() == Approx(1));
}

TEST_CASE("finite poses and rotation angles") {
  Pose T = Pose::Identity();
  CHECK(is_finite(T));
  T.translation().y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(is_finite(T));
  T.translation().y() = -std::numeric_limits<double>::infinity();
  CHECK_FALSE(is_finite(T));

  for (double angle : {0.0, 1e-9, 0.3, 2.0, kPi}) {
    Pose R = Pose::Identity();
    R.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()));
    CHECK(rotation_angle(R) == Approx(angle).margin(1e-12));
    CHECK(rotation_angle(R.inverse()) == Approx(angle).margin(1e-12));
  }
}
