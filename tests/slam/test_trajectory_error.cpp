#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "framework/core/error.hpp"
#include "framework/slam/trajectory_error.hpp"

namespace {

using Path = std::vector<ppm::StampedPose>;

Path path_at(const std::vector<Eigen::Vector3d>& positions, double start_s = 0) {
  Path path;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    ppm::StampedPose p{static_cast<std::int64_t>(i), start_s + static_cast<double>(i), ppm::Pose::Identity()};
    p.T_map_camera.translation() = positions[i];
    path.push_back(p);
  }
  return path;
}

Path random_path(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  Path path;
  for (int i = 0; i < n; ++i) {
    ppm::Twist xi;
    for (auto& x : xi) x = u(random);
    path.push_back({i, 0.1 * i, ppm::se3_exp(xi)});
  }
  return path;
}

}  // namespace

TEST_CASE("a path moved as a whole has no error, and the move is found") {
  ppm::Twist xi;
  xi << 1, -2, 3, 0.5, 1.5, -0.4;
  const ppm::Pose T_ref_est = ppm::se3_exp(xi);
  const Path estimated = random_path(40, 1);
  Path reference = estimated;
  for (auto& p : reference) p.T_map_camera = T_ref_est * p.T_map_camera;
  const auto e = ppm::trajectory_error(estimated, reference);
  CHECK(e.pairs == 40);
  CHECK(e.ate_rmse_m < 1e-12);
  CHECK(e.rpe_trans_rmse_m < 1e-12);
  CHECK(e.rpe_rot_rmse_deg < 1e-6);
  CHECK((e.T_ref_est.matrix() - T_ref_est.matrix()).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("the absolute error of a square with one corner off, by hand") {
  // The four-corner figure is centred at the origin in both paths and mirror-symmetric about the diagonal x = y, so the
  // best rotation is the identity. Off by d along the diagonal at one corner: the centred errors are (3/4, -1/4, -1/4,
  // -1/4) d.
  const Path reference = path_at({{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}});
  Path estimated = reference;
  estimated[0].T_map_camera.translation() += Eigen::Vector3d(0.4, 0.4, 0);
  const double d = 0.4 * std::numbers::sqrt2;
  const auto e = ppm::trajectory_error(estimated, reference);
  CHECK(e.ate_rmse_m == Approx(d * std::sqrt((9.0 + 1 + 1 + 1) / 16 / 4)));
  CHECK(e.ate_max_m == Approx(0.75 * d));
  CHECK(e.T_ref_est.linear().isIdentity(1e-12));
}

TEST_CASE("a path of another scale is not scaled") {
  const Path reference = path_at({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}});
  const Path estimated = path_at({{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}});
  CHECK(ppm::trajectory_error(estimated, reference).ate_rmse_m == Approx(1.0));
}

TEST_CASE("the alignment is a rotation even where a mirror would fit better") {
  const Path reference = path_at({{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {-1, -2, -3}});
  Path mirrored = reference;
  for (auto& p : mirrored) p.T_map_camera.translation().x() *= -1;
  CHECK(ppm::trajectory_error(mirrored, reference).T_ref_est.linear().determinant() == Approx(1.0));
}

TEST_CASE("the relative error of a turn that is one degree too far, by hand") {
  const double deg = std::numbers::pi / 180;
  Path reference = path_at({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  Path estimated = reference;
  // The last step ends 1 degree turned and 3 cm short: two steps, one of them wrong.
  estimated[2].T_map_camera = Eigen::Translation3d(1.97, 0, 0) * Eigen::AngleAxisd(deg, Eigen::Vector3d::UnitZ());
  const auto one = ppm::trajectory_error(estimated, reference);
  CHECK(one.rpe_trans_rmse_m == Approx(0.03 / std::numbers::sqrt2));
  CHECK(one.rpe_rot_rmse_deg == Approx(1 / std::numbers::sqrt2));
  const auto two = ppm::trajectory_error(estimated, reference, 0.02, 2);
  CHECK(two.rpe_trans_rmse_m == Approx(0.03));
  CHECK(two.rpe_rot_rmse_deg == Approx(1));
}

TEST_CASE("poses are associated with the nearest stamp, each once") {
  const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Path reference = path_at(corners);
  Path estimated = path_at(corners, 0.01);
  CHECK(ppm::trajectory_error(estimated, reference).pairs == 4);
  CHECK(ppm::trajectory_error(path_at(corners, 0.99), reference).pairs == 3);
  CHECK_THROWS_AS(ppm::trajectory_error(path_at(corners, 0.5), reference), ppm::DataError);

  // A second estimate near stamp 1 that lies closer takes that reference; the farther one is left out.
  ppm::StampedPose closer = estimated[1];
  closer.stamp_s = 1.001;
  estimated.insert(estimated.begin() + 1, closer);
  const auto e = ppm::trajectory_error(estimated, reference);
  CHECK(e.pairs == 4);
  CHECK(e.ate_rmse_m < 1e-12);
}

TEST_CASE("too few common poses are an error that says how many") {
  using Catch::Matchers::Contains;
  const Path reference = path_at({{0, 0, 0}, {1, 0, 0}});
  CHECK_THROWS_WITH(ppm::trajectory_error(path_at({{0, 0, 0}}), reference), Contains("only 1 of its 1"));
  CHECK_THROWS_WITH(ppm::trajectory_error({}, reference), Contains("only 0 of its 0"));
  CHECK_THROWS_AS(ppm::trajectory_error(reference, {}), ppm::DataError);
  CHECK_THROWS_WITH(ppm::trajectory_error(reference, reference, 0.02, 2), Contains("3 are needed"));
}
