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
  CHECK(e.ate_m.rmse < 1e-12);
  CHECK(e.rpe_trans_m.rmse < 1e-12);
  CHECK(e.rpe_rot_deg.rmse < 1e-6);
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
  CHECK(e.ate_m.rmse == Approx(d * std::sqrt((9.0 + 1 + 1 + 1) / 16 / 4)));
  CHECK(e.ate_m.max == Approx(0.75 * d));
  CHECK(e.T_ref_est.linear().isIdentity(1e-12));
}

TEST_CASE("a path of another scale is not scaled") {
  const Path reference = path_at({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}});
  const Path estimated = path_at({{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}});
  CHECK(ppm::trajectory_error(estimated, reference).ate_m.rmse == Approx(1.0));
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
  CHECK(one.rpe_trans_m.rmse == Approx(0.03 / std::numbers::sqrt2));
  CHECK(one.rpe_rot_deg.rmse == Approx(1 / std::numbers::sqrt2));
  const auto two = ppm::trajectory_error(estimated, reference, 0.02, 2);
  CHECK(two.rpe_trans_m.rmse == Approx(0.03));
  CHECK(two.rpe_rot_deg.rmse == Approx(1));
}

TEST_CASE("statistics of the absolute error on a straight path, by hand: the rotation is open, the errors are not") {
  // Off along the line by (3, -1, -1, -1) cm, on a line that was turned by a right angle and moved.
  const Path reference = path_at({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}, {30, 0, 0}});
  const Path estimated = path_at({{5, 0.03, 7}, {5, 9.99, 7}, {5, 19.99, 7}, {5, 29.99, 7}});
  const auto e = ppm::trajectory_error(estimated, reference);
  CHECK(e.ate_m.rmse == Approx(0.01 * std::numbers::sqrt3).epsilon(1e-12));
  CHECK(e.ate_m.mean == Approx(0.015).epsilon(1e-12));
  CHECK(e.ate_m.median == Approx(0.01).epsilon(1e-12));
  CHECK(e.ate_m.max == Approx(0.03).epsilon(1e-12));
  CHECK(e.T_ref_est.linear().determinant() == Approx(1.0));
  REQUIRE(e.poses.size() == 4);
  CHECK(e.poses[0].error_m == Approx(0.03).epsilon(1e-12));
  CHECK(e.poses[3].error_m == Approx(0.01).epsilon(1e-12));
  CHECK(e.poses[3].frame == 3);
  CHECK(e.poses[3].stamp_s == 3);
}

TEST_CASE("a mirrored path is turned to where its thinnest direction alone is wrong, by hand") {
  // The covariance of the two is diag(-2, 8, 18): without mirrors the least is lost by giving up x. Off by 2 m at (+-1, 0, 0).
  const Path reference = path_at({{1, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 3}, {0, 0, -3}});
  const Path mirrored = path_at({{-1, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 3}, {0, 0, -3}});
  const auto e = ppm::trajectory_error(mirrored, reference);
  CHECK(e.ate_m.rmse == Approx(2 / std::numbers::sqrt3).epsilon(1e-12));
  CHECK(e.ate_m.mean == Approx(2.0 / 3).epsilon(1e-12));
  CHECK(e.ate_m.median == Approx(0).margin(1e-12));
  CHECK(e.ate_m.max == Approx(2).epsilon(1e-12));
}

TEST_CASE("statistics of the relative error of four steps, by hand") {
  const double deg = std::numbers::pi / 180, error[] = {2, 6, 1, 3};  // cm and degrees
  const Path steps = random_path(4, 3);
  Path reference{{0, 0, ppm::Pose::Identity()}}, estimated = reference;
  for (std::size_t i = 0; i < 4; ++i) {
    const ppm::Pose off(Eigen::Translation3d(0, 0.01 * error[i], 0) *
                        Eigen::AngleAxisd(error[i] * deg, Eigen::Vector3d(0.6, 0, 0.8)));
    const ppm::Pose step = steps[i].T_map_camera;
    const auto stamp = static_cast<double>(i + 1);
    reference.push_back({static_cast<std::int64_t>(i + 1), stamp, reference.back().T_map_camera * step});
    estimated.push_back({static_cast<std::int64_t>(i + 1), stamp, estimated.back().T_map_camera * step * off});
  }
  const auto e = ppm::trajectory_error(estimated, reference);
  CHECK(e.rpe_trans_m.rmse == Approx(0.01 * std::sqrt(12.5)).epsilon(1e-10));
  CHECK(e.rpe_trans_m.mean == Approx(0.03).epsilon(1e-10));
  CHECK(e.rpe_trans_m.median == Approx(0.025).epsilon(1e-10));
  CHECK(e.rpe_trans_m.max == Approx(0.06).epsilon(1e-10));
  CHECK(e.rpe_rot_deg.rmse == Approx(std::sqrt(12.5)).epsilon(1e-10));
  CHECK(e.rpe_rot_deg.mean == Approx(3).epsilon(1e-10));
  CHECK(e.rpe_rot_deg.median == Approx(2.5).epsilon(1e-10));
  CHECK(e.rpe_rot_deg.max == Approx(6).epsilon(1e-10));
}

TEST_CASE("a step that ends in the right place, turned wrongly, has no relative error of translation") {
  const Path reference = path_at({{0, 0, 0}, {1, 0, 0}});
  Path estimated = reference;
  estimated[1].T_map_camera.rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  const auto e = ppm::trajectory_error(estimated, reference);
  CHECK(e.rpe_trans_m.rmse == Approx(0).margin(1e-12));  // (Q^-1 P): in the other order it would be sqrt(2)
  CHECK(e.rpe_rot_deg.rmse == Approx(90));
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
  CHECK(e.ate_m.rmse < 1e-12);
}

TEST_CASE("stamps may be as far apart as is said, and no farther") {
  const Path reference = path_at({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  CHECK(ppm::trajectory_error(path_at({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 0.25), reference, 0.25).pairs == 3);
  CHECK(ppm::trajectory_error(path_at({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, -0.25), reference, 0.25).pairs == 3);
  CHECK_THROWS_AS(ppm::trajectory_error(path_at({{0, 0, 0}, {1, 0, 0}}, 0.25), reference, 0.2499), ppm::DataError);
  CHECK(ppm::trajectory_error(reference, reference, 0).pairs == 3);
}

TEST_CASE("the nearest stamps find each other first, whoever is left takes what is left") {
  const Path reference = path_at({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  Path estimated = path_at({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  estimated[1].stamp_s = 0.875;   // 0.125 from 1
  estimated[2].stamp_s = 1.375;   // 0.375 from 1, which is taken; 0.625 from 2
  CHECK(ppm::trajectory_error(estimated, reference, 0.5).pairs == 2);
  const auto e = ppm::trajectory_error(estimated, reference, 0.625);
  CHECK(e.pairs == 3);
  CHECK(e.ate_m.max < 1e-12);
}

TEST_CASE("too few common poses are an error that says how many") {
  using Catch::Matchers::Contains;
  const Path reference = path_at({{0, 0, 0}, {1, 0, 0}});
  CHECK_THROWS_WITH(ppm::trajectory_error(path_at({{0, 0, 0}}), reference), Contains("only 1 of its 1"));
  CHECK_THROWS_WITH(ppm::trajectory_error({}, reference), Contains("only 0 of its 0"));
  CHECK_THROWS_AS(ppm::trajectory_error(reference, {}), ppm::DataError);
  CHECK_THROWS_WITH(ppm::trajectory_error(reference, reference, 0.02, 2), Contains("3 are needed"));
}
