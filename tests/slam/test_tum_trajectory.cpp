#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <random>

#include "framework/core/error.hpp"
#include "framework/slam/tum_trajectory.hpp"

namespace {

std::filesystem::path written(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() / "ppm_test_tum_trajectory.tum";
  std::ofstream(file) << text;
  return file;
}

std::string error_of(const std::string& text) {
  try {
    ppm::read_tum(written(text));
  } catch (const ppm::DataError& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a path survives being written and read") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-2, 2);
  std::vector<ppm::StampedPose> path;
  for (int i = 0; i < 50; ++i) {
    ppm::Twist xi;
    for (auto& x : xi) x = u(random);
    path.push_back({i, 1305031102.175304 + 0.033 * i, ppm::se3_exp(xi)});
  }
  const auto back = ppm::read_tum(written(ppm::to_tum(path)));
  REQUIRE(back.size() == path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    CHECK(back[i].frame == path[i].frame);
    CHECK(std::abs(back[i].stamp_s - path[i].stamp_s) < 1e-6);
    CHECK((back[i].T_map_camera.matrix() - path[i].T_map_camera.matrix()).cwiseAbs().maxCoeff() < 1e-8);
  }
}

TEST_CASE("comments, blank lines, tabs and Windows line ends are read") {
  const auto path =
      ppm::read_tum(written("# stamp tx ty tz qx qy qz qw\r\n\r\n 1.5\t1 2 3  0 0 0 1\r\n#\n2 0 0 0 0 0 0.6 0.8"));
  REQUIRE(path.size() == 2);
  CHECK(path[0].stamp_s == 1.5);
  CHECK(path[0].T_map_camera.translation() == Eigen::Vector3d(1, 2, 3));
  CHECK(path[1].T_map_camera.linear()(0, 0) == Approx(1 - 2 * 0.36));
}

TEST_CASE("a broken trajectory file is told with its line") {
  using Catch::Matchers::Contains;
  CHECK_THAT(error_of("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0\n"), Contains("trajectory.tum:2:1") && Contains("7 numbers"));
  CHECK_THAT(error_of("#\n1 0 0 0 0 0 0 1 9\n"), Contains(":2:1") && Contains("9 numbers"));
  CHECK_THAT(error_of("1 0 zero 0 0 0 0 1\n"), Contains(":1:1") && Contains("'zero'"));
  CHECK_THAT(error_of("1 0 nan 0 0 0 0 1\n"), Contains(":1:1") && Contains("'nan'"));
  CHECK_THAT(error_of("1 0 0 0 0 0 0 0\n"), Contains(":1:1") && Contains("norm"));
  CHECK_THAT(error_of("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"), Contains(":2:1") && Contains("stamp"));
  CHECK_THAT(error_of("# nothing\n"), Contains("holds no pose"));
  CHECK_THROWS_WITH(ppm::read_tum("no/such/file.tum"), Contains("no/such/file.tum"));
}
