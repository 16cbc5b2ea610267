#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "framework/slam/kld_sampling.hpp"
#include "framework/slam/pose_clusters.hpp"

using namespace ppm;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

Pose at(double x, double turn_deg = 0) {
  return Eigen::Translation3d(x, 0, 0) * Pose(Eigen::AngleAxisd(turn_deg * kDegree, Eigen::Vector3d::UnitZ()));
}

}  // namespace

TEST_CASE("normal quantiles are those of the tables") {
  CHECK(normal_quantile(0.5) == Approx(0).margin(1e-12));
  CHECK(normal_quantile(0.975) == Approx(1.959963985).epsilon(1e-8));
  CHECK(normal_quantile(0.99) == Approx(2.326347874).epsilon(1e-8));
  CHECK(normal_quantile(0.01) == Approx(-2.326347874).epsilon(1e-8));
}

TEST_CASE("the KLD bound is the chi-square quantile over twice the error") {
  const double z = normal_quantile(0.99);
  // 0.99 quantiles of chi-square, from tables; Wilson and Hilferty's form is within 1.5 % from 2 degrees of freedom on.
  const std::pair<std::size_t, double> quantiles[] = {{2, 9.210}, {5, 15.086}, {10, 23.209}, {30, 50.892}, {100, 135.807}};
  for (const auto& [freedom, quantile] : quantiles)
    CHECK(kld_bound(freedom + 1, 0.05, z) == Approx(quantile / 0.1).epsilon(0.015));
  CHECK(kld_bound(0, 0.05, z) == 1);
  CHECK(kld_bound(1, 0.05, z) == 1);
}

TEST_CASE("the KLD bound grows with bins and with the probability, and falls with the error") {
  const double z = normal_quantile(0.95);
  for (std::size_t k = 2; k < 300; ++k) {
    REQUIRE(kld_bound(k + 1, 0.05, z) > kld_bound(k, 0.05, z));
    REQUIRE(kld_bound(k, 0.05, z + 0.5) > kld_bound(k, 0.05, z));
    if (kld_bound(k, 0.1, z) > 1) REQUIRE(kld_bound(k, 0.1, z) == Approx(kld_bound(k, 0.05, z) / 2));
  }
}

TEST_CASE("poses share a bin where each of their six coordinates rounds alike, wherever the map's origin lies") {
  const std::vector<Pose> poses{at(0), at(0.02), at(0.06), at(0, 0.9), at(0, 2.2), at(0.06, 0.5)};
  CHECK(pose_bins(poses, Pose::Identity(), 0.05, 2 * kDegree) == std::vector<std::uint32_t>{0, 0, 1, 0, 2, 1});
  const Pose T = Eigen::Translation3d(-7, 3, 1) * Pose(Eigen::AngleAxisd(3.1, Eigen::Vector3d(1, 2, 2) / 3));
  std::vector<Pose> moved;
  for (const auto& pose : poses) moved.push_back(T * pose);
  CHECK(pose_bins(moved, T, 0.05, 2 * kDegree) == pose_bins(poses, Pose::Identity(), 0.05, 2 * kDegree));
}

TEST_CASE("KLD-sampling stops at the bound for the bins that its draws meet, and between its limits") {
  KldLimits limits;
  limits.least = 10;
  limits.most = 2000;
  const auto number = [&](std::size_t bins) {
    std::vector<std::uint32_t> bin(400);
    for (std::size_t i = 0; i < bin.size(); ++i) bin[i] = static_cast<std::uint32_t>(i % bins);
    return kld_number(std::vector<double>(bin.size(), 1.0 / 400), bin, limits, Rng(1, 0, 0, 0));
  };
  CHECK(number(1) == 10);
  for (std::size_t bins : {5u, 20u, 40u})  // so many draws meet each bin
    CHECK(number(bins) == static_cast<std::size_t>(std::ceil(kld_bound(bins, limits.error, limits.z))));
  CHECK(number(400) == 2000);
  limits.most = 100;
  CHECK(number(40) == 100);
}

TEST_CASE("bins that weights leave empty do not count for KLD-sampling") {
  std::vector<double> weights(50, 0.0);
  weights[7] = 0.6;
  weights[31] = 0.4;
  std::vector<std::uint32_t> bin(50);
  for (std::size_t i = 0; i < bin.size(); ++i) bin[i] = static_cast<std::uint32_t>(i);
  KldLimits limits;
  limits.least = 10;
  CHECK(kld_number(weights, bin, limits, Rng(1, 0, 0, 0)) ==
        static_cast<std::size_t>(std::ceil(kld_bound(2, limits.error, limits.z))));
}

TEST_CASE("poses cluster around the heaviest, by distance and by angle") {
  const std::vector<Pose> poses{at(0), at(0.01), at(0.5), at(0.5, 1), at(0.5, 10), at(0.02)};
  const std::vector<double> weights{0.1, 0.3, 0.2, 0.2, 0.2, 0.0};
  const auto clusters = pose_clusters(poses, weights, 0.03, 2 * kDegree);
  REQUIRE(clusters.size() == 3);
  CHECK(clusters[0].leader == 1);
  CHECK(clusters[0].weight == Approx(0.4));
  CHECK(clusters[1].leader == 2);
  CHECK(clusters[1].weight == Approx(0.4));
  CHECK(clusters[2].leader == 4);
  CHECK(clusters[2].weight == Approx(0.2));
}
