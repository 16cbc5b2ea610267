#include <catch2/catch.hpp>

#include "tests/support/imu_world.hpp"

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ppm::ImuMotion;
using ppm::test::SwingingBody;

double largest(const Eigen::MatrixXd& a) {
  return a.cwiseAbs().maxCoeff();
}

Vector3d rotation_error(const Matrix3d& a, const Matrix3d& b) {
  ppm::Pose T = ppm::Pose::Identity();
  T.linear() = a.transpose() * b;
  return ppm::se3_log(T).tail<3>();
}

/// What the samples should add up to, from the exact path.
ImuMotion exact(const SwingingBody& body, double begin_s, double end_s) {
  ImuMotion m;
  m.dt = end_s - begin_s;
  const Matrix3d back = body.rotation(begin_s).transpose();
  m.R = back * body.rotation(end_s);
  m.v = back * (body.velocity(end_s) - body.velocity(begin_s) - m.dt * SwingingBody::gravity());
  m.p = back * (body.position(end_s) - body.position(begin_s) - m.dt * body.velocity(begin_s) -
                0.5 * m.dt * m.dt * SwingingBody::gravity());
  return m;
}

ImuMotion measured(const SwingingBody& body, double begin_s, double end_s, double step_s, const ppm::ImuBias& bias = {}) {
  return ppm::preintegrate(body.samples(begin_s, end_s, step_s), body.sample(begin_s), begin_s, end_s, bias, {});
}

double error_of(const ImuMotion& a, const ImuMotion& b) {
  return std::max({largest(rotation_error(a.R, b.R)), largest(a.v - b.v), largest(a.p - b.p)});
}

}  // namespace

TEST_CASE("a constant force without rotation, and a constant rate, add up in closed form") {
  const Vector3d w(0.3, -0.2, 0.5), a(1, -2, 9);
  ImuMotion straight, turn;
  for (int k = 0; k < 50; ++k) {
    straight.add(Vector3d::Zero(), a, 0.01, {});
    turn.add(w, Vector3d::Zero(), 0.01, {});
  }
  CHECK(straight.dt == Approx(0.5));
  CHECK(largest(straight.v - 0.5 * a) < 1e-12);
  CHECK(largest(straight.p - 0.125 * a) < 1e-12);
  CHECK(largest(turn.R - ppm::so3_exp(0.5 * w)) < 1e-12);
}

TEST_CASE("a constant rate with a constant force of the body: the error falls with the square of the step") {
  // About z with rate w, force f along x: v = f/w (sin wt, 1 - cos wt), p = f/w^2 (1 - cos wt, wt - sin wt).
  const double w = 2, f = 3, t = 0.8;
  const auto error = [&](int steps) {
    ImuMotion m;
    for (int k = 0; k < steps; ++k) m.add({0, 0, w}, {f, 0, 0}, t / steps, {});
    const Vector3d v(f / w * std::sin(w * t), f / w * (1 - std::cos(w * t)), 0);
    const Vector3d p(f / w / w * (1 - std::cos(w * t)), f / w / w * (w * t - std::sin(w * t)), 0);
    return std::max(largest(m.v - v), largest(m.p - p));
  };
  CHECK(error(100) < 1e-4);
  CHECK(error(100) / error(200) == Approx(4).epsilon(0.02));
}

TEST_CASE("samples of a body that swings add up to its motion, wherever the images lie between them") {
  const SwingingBody body;
  CHECK(error_of(measured(body, 1.0, 1.1, 0.005), exact(body, 1.0, 1.1)) < 2e-6);
  const double coarse = error_of(measured(body, 1.0, 2.0, 0.01), exact(body, 1.0, 2.0));
  const double fine = error_of(measured(body, 1.0, 2.0, 0.005), exact(body, 1.0, 2.0));
  CHECK(coarse / fine == Approx(4).epsilon(0.1));
  // Images between samples: the sample before and the last one stand in up to the edges.
  const double begin = 1.0023, end = 1.1037;
  const auto m = ppm::preintegrate(body.samples(begin, end, 0.005), body.sample(1.0), begin, end, {}, {});
  CHECK(m.dt == Approx(end - begin));
  CHECK(error_of(m, exact(body, begin, end)) < 2e-4);  // held from the last sample, 3.7 ms, to the image
}

TEST_CASE("the bias Jacobians are those of finite differences") {
  const SwingingBody body{2};
  const ppm::ImuBias bias{{0.01, -0.02, 0.03}, {0.1, 0.2, -0.1}};
  const ImuMotion m = measured(body, 0.5, 0.9, 0.01, bias);
  constexpr double h = 1e-5;
  for (int a = 0; a < 3; ++a) {
    ppm::ImuBias up = bias, down = bias;
    up.gyro[a] += h, down.gyro[a] -= h;
    ImuMotion p = measured(body, 0.5, 0.9, 0.01, up), q = measured(body, 0.5, 0.9, 0.01, down);
    CHECK(largest(m.R_gyro.col(a) - rotation_error(q.R, p.R) / (2 * h)) < 1e-8);
    CHECK(largest(m.v_gyro.col(a) - (p.v - q.v) / (2 * h)) < 1e-8);
    CHECK(largest(m.p_gyro.col(a) - (p.p - q.p) / (2 * h)) < 1e-8);
    up = down = bias;
    up.accel[a] += h, down.accel[a] -= h;
    p = measured(body, 0.5, 0.9, 0.01, up), q = measured(body, 0.5, 0.9, 0.01, down);
    CHECK(largest(m.v_accel.col(a) - (p.v - q.v) / (2 * h)) < 1e-8);
    CHECK(largest(m.p_accel.col(a) - (p.p - q.p) / (2 * h)) < 1e-8);
  }
}

TEST_CASE("other biases, to first order, are as if the samples were added up anew") {
  const SwingingBody body{2};
  const ppm::ImuBias near{{0.004, -0.003, 0.002}, {0.05, -0.04, 0.03}};
  const auto moved = measured(body, 0.5, 0.6, 0.005).with_bias(near);
  CHECK(moved.bias.gyro == near.gyro);
  CHECK(error_of(moved, measured(body, 0.5, 0.6, 0.005, near)) < 1e-6);
}

TEST_CASE("the covariance of a motion is that of noisy samples") {
  const SwingingBody body{2};
  const double step_s = 0.005, begin = 0.5, end = 0.8;
  ppm::ImuNoise noise{0.02, 0.2, 0, 0};
  const auto clean = body.samples(begin, end, step_s);
  const auto add_up = [&](ppm::Rng* rng) {
    ImuMotion m;
    for (auto s : clean) {
      if (rng) s.gyro += ppm::test::normal3(*rng, noise.gyro / std::sqrt(step_s));
      if (rng) s.accel += ppm::test::normal3(*rng, noise.accel / std::sqrt(step_s));
      m.add(s.gyro, s.accel, step_s, noise);
    }
    return m;
  };
  const ImuMotion m = add_up(nullptr);
  constexpr int runs = 4000;
  ImuMotion::Matrix9 sampled = ImuMotion::Matrix9::Zero();
  for (int k = 0; k < runs; ++k) {
    ppm::Rng rng(1, static_cast<std::uint32_t>(k), 0, 0);
    const ImuMotion other = add_up(&rng);
    Eigen::Matrix<double, 9, 1> e;
    e << rotation_error(m.R, other.R), other.v - m.v, other.p - m.p;
    sampled += e * e.transpose() / runs;
  }
  // The standard error of a covariance is at most sqrt(2 / runs) of the deviations' product: 2.2 %.
  const Eigen::Matrix<double, 9, 1> sigma = m.covariance.diagonal().cwiseSqrt();
  const ImuMotion::Matrix9 scaled = (sampled - m.covariance).cwiseQuotient(sigma * sigma.transpose());
  CHECK(largest(scaled) < 0.09);
}
