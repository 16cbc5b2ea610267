#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/core/error.hpp"
#include "framework/slam/depth_score.hpp"

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A row of pixels far from wide angle: ray directions are the optical axis to within 1e-6.
ppm::Frame row_of(const std::vector<float>& depth) {
  ppm::Frame f;
  f.camera = {static_cast<int>(depth.size()), 1, 1e6, 1e6, 0, 0};
  f.depth = depth;
  for (float z : depth) f.sigma.push_back(z == z ? 0.01f : kNan);
  return f;
}

ppm::Prediction facing(const ppm::Frame& frame, const std::vector<float>& range) {
  ppm::Prediction p;
  p.reset(frame.camera, 1, ppm::Pose::Identity());
  for (std::size_t i = 0; i < range.size(); ++i) {
    if (range[i] == ppm::Prediction::kMiss) continue;
    p.range[i] = range[i];
    p.chunk[i] = 0;
    p.normal[3 * i + 2] = -1;
  }
  return p;
}

double gaussian(double x, double variance) {
  return std::exp(-0.5 * x * x / variance) / std::sqrt(2 * std::numbers::pi * variance);
}

}  // namespace

TEST_CASE("depth score of five pixels, by hand") {
  constexpr float miss = ppm::Prediction::kMiss;
  const auto frame = row_of({2, 2, 2, 2, kNan});
  const auto prediction = facing(frame, {2.005f, 1.985f, 2.5f, miss, 3});
  ppm::DepthScorer scorer;
  scorer.add(frame, prediction, 1);
  const auto s = scorer.score();
  CHECK(s.pixels == 4);  // the pixel without a return does not count
  CHECK(s.coverage == 0.75);
  CHECK(s.median_mm == Approx(15).epsilon(1e-3));
  CHECK(s.within_1cm == 0.25);
  CHECK(s.within_2cm == 0.5);
  CHECK(s.within_5cm == 0.5);
  CHECK(s.mean_trunc20cm_mm == Approx((5 + 15 + 200 + 200) / 4.0).epsilon(1e-3));
  const double v = 0.01 * 0.01;
  const double expected = std::log(0.95 * gaussian(0.005, v) + 0.005) + std::log(0.95 * gaussian(0.015, v) + 0.005) +
                          std::log(0.005) + std::log(0.1);
  CHECK(s.log_density == Approx(expected / 4).epsilon(1e-3));
  CHECK(s.outliers == Approx(1.0 / 3));  // the pixel that is 50 standard deviations off
  CHECK(s.within_1_sigma == 0.5);
  CHECK(s.within_2_sigma == 1);
  const double crps = ppm::truncated_crps(0.005, 0.01, 0.2) + ppm::truncated_crps(0.015, 0.01, 0.2) +
                      ppm::truncated_crps(0.5, 0.01, 0.2) + 0.1;
  CHECK(s.crps_mm == Approx(1e3 * crps / 4).epsilon(1e-3));
}

TEST_CASE("the calibration curve of chosen errors, by hand: inliers alone count") {
  // 0.5, 1, 1.5 and 2 standard deviations of 1 cm off, one outlier, one miss.
  const auto frame = row_of({2, 2, 2, 2, 2, 2});
  ppm::DepthScorer scorer;
  scorer.add(frame, facing(frame, {2.005f, 1.99f, 2.015f, 1.98f, 3, ppm::Prediction::kMiss}), 1);
  const auto s = scorer.score();
  const auto& nominal = ppm::CalibrationCurve::nominal();
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    int within = 0;
    for (double z : {0.5, 1.0, 1.5, 2.0}) within += std::erf(z / std::numbers::sqrt2) <= nominal[i];
    INFO(nominal[i]);
    CHECK(s.calibration[i] == within / 4.0);
  }
  CHECK(s.calibration.front() == 0);
  CHECK(s.calibration.back() == 1);
}

TEST_CASE("what frames add to a score is the same added frame by frame or collected before") {
  const auto a = row_of({2, 2, 2}), b = row_of({2, kNan});
  const auto of_a = facing(a, {2.005f, 1.985f, 2.5f}), of_b = facing(b, {ppm::Prediction::kMiss, 3});
  ppm::DepthScorer both, first, second;
  both.add(a, of_a, 1);
  both.add(b, of_b, 1);
  first.add(a, of_a, 1);
  second.add(b, of_b, 1);
  first.add(second);
  const auto one = both.score(), other = first.score();
  CHECK(one.pixels == other.pixels);
  CHECK(one.coverage == other.coverage);
  CHECK(one.median_mm == other.median_mm);
  CHECK(one.log_density == Approx(other.log_density));
  CHECK(one.crps_mm == Approx(other.crps_mm));
  CHECK(one.calibration == other.calibration);
  CHECK(one.outliers == other.outliers);
}

TEST_CASE("no pixel is calibrated where all are outliers") {
  const auto frame = row_of({2});
  ppm::DepthScorer scorer;
  scorer.add(frame, facing(frame, {3}), 1);
  CHECK(scorer.score().outliers == 1);
  CHECK(scorer.score().within_1_sigma == 0);
}

TEST_CASE("a miss counts in the median") {
  constexpr float miss = ppm::Prediction::kMiss;
  const auto frame = row_of({2, 2, 2});
  ppm::DepthScorer scorer;
  scorer.add(frame, facing(frame, {2, miss, miss}), 1);
  CHECK(std::isinf(scorer.score().median_mm));
}

TEST_CASE("errors are along the ray, and the map's variance counts") {
  ppm::Frame frame;
  frame.camera = {1, 1, 1, 1, -1, 0};  // the only ray is (1, 0, 1): sqrt(2) of range for each metre of depth
  frame.depth = {2};
  frame.sigma = {0.01f};
  const double root2 = std::numbers::sqrt2;
  auto p = facing(frame, {static_cast<float>(2 * root2)});
  p.variance[0] = 0.0004f;
  p.mean[0] = -0.02f;  // cosine 1/sqrt(2): 2.83 cm farther along the ray
  ppm::DepthScorer scorer;
  scorer.add(frame, p, 1);
  const auto s = scorer.score();
  CHECK(s.median_mm == Approx(20 * root2).epsilon(1e-4));
  const double variance = 0.0004 * 2 + 0.0001 * 2;
  CHECK(s.log_density == Approx(std::log(0.95 * gaussian(0.02 * root2, variance) + 0.005)).epsilon(1e-4));
}

TEST_CASE("the compared pixels are those in the middle of each step") {
  ppm::Frame frame;
  frame.camera = {16, 16, 1e6, 1e6, 0, 0};
  frame.depth.assign(256, kNan);
  frame.sigma.assign(256, kNan);
  frame.depth[4 * 16 + 12] = 2;
  frame.sigma[4 * 16 + 12] = 0.01f;
  const auto camera = ppm::DepthScorer::sampling_camera(frame.camera, 8);
  ppm::Prediction p;
  p.reset(camera, 1, ppm::Pose::Identity());
  ppm::DepthScorer scorer;
  scorer.add(frame, p, 8);
  CHECK(scorer.score().pixels == 1);
  CHECK_THROWS_AS(scorer.add(frame, p, 4), ppm::InternalError);
}

TEST_CASE("nothing to compare is an error") {
  CHECK_THROWS_AS(ppm::DepthScorer().score(), ppm::DataError);
}
