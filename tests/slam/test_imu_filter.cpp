#include <catch2/catch.hpp>
#include <Eigen/Eigenvalues>

#include "framework/slam/imu_filter.hpp"
#include "tests/support/imu_world.hpp"

namespace {

using ppm::ImuFilter;
using ppm::Matrix6;
using ppm::Pose;
using ppm::test::NoisyImu;
using ppm::test::SwingingBody;

constexpr double kStep_s = 0.01, kFrame_s = 0.1;

Matrix6 pose_noise(double sigma_t, double sigma_r) {
  ppm::Twist s;
  s << Eigen::Vector3d::Constant(sigma_t * sigma_t), Eigen::Vector3d::Constant(sigma_r * sigma_r);
  return s.asDiagonal();
}

ImuFilter truth_at(const SwingingBody& body, double s, const ppm::ImuBias& bias) {
  ImuFilter truth;
  truth.stamp_s = s;
  truth.T_map_base = body.pose(s);
  truth.velocity = body.velocity(s);
  truth.bias = bias;
  truth.gravity = SwingingBody::gravity();
  return truth;
}

/// Squared error in units of the covariance, over the 17 directions that are not known.
double nees(const ImuFilter& filter, const ImuFilter& truth) {
  const Eigen::SelfAdjointEigenSolver<ImuFilter::Covariance> eigen(filter.covariance);
  const ImuFilter::Error e = eigen.eigenvectors().transpose() * filter.error_of(truth);
  double sum = 0;
  for (int i = 1; i < ImuFilter::kSize; ++i) sum += e[i] * e[i] / eigen.eigenvalues()[i];
  return sum;
}

/// A filter that follows a body whose poses are told with noise.
struct Follower {
  SwingingBody body;
  ppm::ImuNoise noise{1e-3, 1e-2, 1e-4, 1e-3};
  ppm::ImuStart start{0.7, 0.6, 0.02, 0.1};
  Matrix6 told = pose_noise(0.003, 0.003);
  NoisyImu imu;
  ppm::Rng rng;
  ImuFilter filter;
  double s = 1, innovation = 0;

  explicit Follower(std::uint32_t run)
      : imu{noise, {}, ppm::Rng(1, run, 0, 1)}, rng(1, run, 0, 2) {
    imu.bias = {ppm::test::normal3(rng, start.gyro_bias), ppm::test::normal3(rng, start.accel_bias)};
    const auto first = imu.measure(body.sample(s), kStep_s);
    filter.begin(s, tell(), std::span(&first, 1), told, start);
  }
  Pose tell() {
    ppm::Twist e;
    e << ppm::test::normal3(rng, 0.003), ppm::test::normal3(rng, 0.003);
    return body.pose(s) * ppm::se3_exp(e);
  }
  void frame() {
    ppm::ImuMotion motion;
    motion.bias = filter.bias;
    for (double t = 0.5 * kStep_s; t < kFrame_s; t += kStep_s) {
      const auto sample = imu.measure(body.sample(s + t), kStep_s);
      motion.add(sample.gyro, sample.accel, kStep_s, noise);
    }
    filter.predict(motion, noise);
    s += kFrame_s;
    const Pose here = tell();
    innovation = filter.distance(here, told);
    filter.correct(here, told);
  }
};

}  // namespace

TEST_CASE("exact samples and exact poses: velocity, biases and gravity are found") {
  SwingingBody body;
  const ppm::ImuBias bias{{0.01, -0.015, 0.02}, {0.05, 0.08, -0.06}};
  const auto biased = [&](double begin_s, double end_s) {
    auto samples = body.samples(begin_s, end_s, 0.002);
    for (auto& s : samples) s.gyro += bias.gyro, s.accel += bias.accel;
    return samples;
  };
  const ppm::ImuNoise noise{1e-4, 1e-3, 1e-7, 1e-6};
  const Matrix6 told = pose_noise(1e-4, 1e-4);
  ImuFilter filter;
  CHECK_FALSE(filter.begun());
  filter.begin(1, body.pose(1), biased(0.99, 1), told, {1, 1, 0.05, 0.2});
  CHECK(filter.begun());
  CHECK((filter.gravity - SwingingBody::gravity()).norm() < 1.5);  // the body accelerates
  std::optional<ppm::ImuSample> last;
  for (int k = 0; k < 150; ++k) {
    const double begin_s = 1 + 0.1 * k, end_s = 1 + 0.1 * (k + 1);
    const auto samples = biased(begin_s, end_s);
    filter.predict(ppm::preintegrate(samples, last, begin_s, end_s, {}, noise), noise);
    last = samples.back();
    filter.correct(body.pose(end_s), told);
  }
  const auto error = filter.error_of(truth_at(body, 16, bias));
  CHECK(error.segment<3>(6).norm() < 2e-3);
  CHECK(error.segment<3>(9).norm() < 2e-4);
  CHECK(error.segment<3>(12).norm() < 1e-2);
  CHECK(error.segment<3>(15).norm() < 1e-2);
  CHECK(filter.gravity.norm() == Approx(ImuFilter::kGravity));
}

TEST_CASE("what the filter does not know is as large as it says: over runs, from the start on") {
  constexpr int runs = 60, frames = 60;
  std::vector<double> state(frames), innovation(frames);
  for (std::uint32_t run = 0; run < runs; ++run) {
    Follower follower(run);
    for (std::size_t k = 0; k < frames; ++k) {
      follower.frame();
      state[k] += nees(follower.filter, truth_at(follower.body, follower.s, follower.imu.bias)) / runs;
      innovation[k] += follower.innovation / runs;
    }
  }
  // A mean of 60 chi-square values of n degrees has the deviation sqrt(2 n / 60): 0.75 of 17, 0.45 of 6. Velocity and
  // acceleration at the start are the same in all runs, no draws, so that the first frames are a little off.
  for (std::size_t k = 6; k < frames; k += 6) {
    INFO("frame " << k);
    CHECK(state[k] == Approx(17).margin(4.5));
    CHECK(innovation[k] == Approx(6).margin(2.3));
  }
  double mean = 0;
  for (double x : innovation) mean += x / frames;
  CHECK(mean == Approx(6).margin(0.35));
}

TEST_CASE("the filter's Jacobians are those of finite differences") {
  Follower follower(3);
  for (int k = 0; k < 5; ++k) follower.frame();
  // Predicts two states that differ by a small error, without noise: the errors after it are F times it.
  ppm::ImuMotion motion;
  for (const auto& s : follower.body.samples(2, 2.1, kStep_s)) motion.add(s.gyro, s.accel, kStep_s, {0, 0, 0, 0});
  const ppm::ImuNoise none{0, 0, 0, 0};
  const ImuFilter base = follower.filter;
  motion.covariance.setZero();
  constexpr double h = 1e-5;
  for (int a = 0; a < ImuFilter::kSize; ++a) {
    ImuFilter::Error e = ImuFilter::Error::Zero();
    e[a] = h;
    ImuFilter other = base, here = base;
    other.T_map_base = base.T_map_base * ppm::se3_exp(e.head<6>());
    other.velocity += e.segment<3>(6);
    other.bias.gyro += e.segment<3>(9);
    other.bias.accel += e.segment<3>(12);
    other.gravity += e.tail<3>();
    here.covariance = e * e.transpose() / (h * h);
    here.predict(motion, none);
    other.predict(motion, none);
    const ImuFilter::Error after = here.error_of(other) / h;
    INFO("error " << a);
    // Not gravity's own rows: an error along it is none.
    CHECK((here.covariance - after * after.transpose()).topLeftCorner<15, 15>().cwiseAbs().maxCoeff() < 2e-4);
  }
}

TEST_CASE("a body that was carried elsewhere has a velocity that is not known, and biases that are") {
  Follower follower(1);
  for (int k = 0; k < 40; ++k) follower.frame();
  const auto before = follower.filter;
  ppm::Twist far;
  far << 1, 0, 0, 0, 0, 0.5;
  const Pose elsewhere = before.T_map_base * ppm::se3_exp(far);
  CHECK(follower.filter.distance(elsewhere, follower.told) > 1000);
  follower.filter.restart(7, elsewhere, follower.told, follower.start);
  CHECK(follower.filter.stamp_s == 7);
  CHECK(follower.filter.velocity.norm() == 0);
  CHECK(follower.filter.covariance(6, 6) == Approx(0.49));
  CHECK(follower.filter.covariance.topRows<9>().rightCols<9>().norm() == 0);
  CHECK(follower.filter.bias.gyro == before.bias.gyro);
  CHECK(follower.filter.gravity == before.gravity);
  CHECK(follower.filter.covariance.bottomRightCorner<9, 9>() == before.covariance.bottomRightCorner<9, 9>());
}

TEST_CASE("a pose that slipped moves velocity little, and is counted") {
  Follower follower(2);
  for (int k = 0; k < 40; ++k) follower.frame();
  ppm::Twist slip = ppm::Twist::Zero();
  slip[0] = 0.3;
  const Pose slipped = follower.filter.T_map_base * ppm::se3_exp(slip);
  ImuFilter trusting = follower.filter, wary = follower.filter;
  trusting.correct(slipped, follower.told);
  wary.correct_at_most(slipped, follower.told, 17);
  CHECK(wary.slips == 1);
  const auto moved = [&](const ImuFilter& f) { return (f.velocity - follower.filter.velocity).norm(); };
  CHECK(moved(trusting) > 0.05);
  CHECK(moved(wary) < 0.1 * moved(trusting));
  wary.correct_at_most(wary.T_map_base, follower.told, 17);
  CHECK(wary.slips == 0);
  // Within the gate it is the same as correct().
  slip[0] = 0.002;
  ImuFilter a = follower.filter, b = follower.filter;
  a.correct(a.T_map_base * ppm::se3_exp(slip), follower.told);
  b.correct_at_most(b.T_map_base * ppm::se3_exp(slip), follower.told, 17);
  CHECK(a.velocity == b.velocity);
  CHECK(b.slips == 0);
}
