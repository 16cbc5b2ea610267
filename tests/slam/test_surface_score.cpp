#include <catch2/catch.hpp>
#include <cmath>

#include "framework/slam/surface_score.hpp"

using namespace ppm;

namespace {

/// The plane z = 0, without end.
class Floor final : public TrueSurface {
 public:
  void cast(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3f> direction,
            std::span<float> range_m) const override {
    for (std::size_t i = 0; i < direction.size(); ++i) range_m[i] = static_cast<float>(-origin.z() / direction[i].z());
  }
  double distance(const Eigen::Vector3d& p) const override { return std::abs(p.z()); }
};

/// Two triangles that cover [0, side]^2 at a height.
void add_square(Mesh& mesh, float side, float z, float x = 0) {
  const auto at = static_cast<std::uint32_t>(mesh.position.size());
  for (const auto& [u, v] : {std::pair{0.f, 0.f}, {side, 0.f}, {side, side}, {0.f, side}})
    mesh.position.emplace_back(x + u, v, z);
  mesh.face.push_back({at, at + 1, at + 2});
  mesh.face.push_back({at, at + 2, at + 3});
}

/// Points of the floor, 1 cm apart, in [0, x] x [0, 1].
std::vector<Eigen::Vector3f> seen_floor(float x) {
  std::vector<Eigen::Vector3f> points;
  for (float u = 0.005f; u < x; u += 0.01f)
    for (float v = 0.005f; v < 1; v += 0.01f) points.emplace_back(u, v, 0.f);
  return points;
}

}  // namespace

TEST_CASE("a map that floats above half of the floor, by hand") {
  Mesh mesh;
  add_square(mesh, 1, 0.004f);
  const auto s = score_surface(mesh, Pose::Identity(), Floor(), seen_floor(2), Workers(2));
  CHECK(s.accuracy.points == kSurfaceSamples);
  CHECK(s.accuracy.median_mm == Approx(4).epsilon(1e-4));
  CHECK(s.accuracy.mean_mm == Approx(4).epsilon(1e-4));
  CHECK(s.accuracy.within_1cm == 1);
  CHECK(s.precision() == 1);
  CHECK(s.completeness.points == 20000);
  CHECK(s.completeness.within_1cm == Approx(0.5).margin(0.006));
  // Of the other half the points up to sqrt(2^2 - 0.4^2) cm beyond the edge are near.
  CHECK(s.recall() == Approx(0.51).margin(0.001));
  CHECK(s.completeness.within_5cm == Approx(0.525).margin(0.001));
  CHECK(s.completeness.mean_mm == Approx(0.5 * 4 + 0.5 * 500).epsilon(2e-3));
  CHECK(s.f_score() == Approx(2 * 0.51 / 1.51).margin(0.001));
}

TEST_CASE("what the map makes up counts against its accuracy, by area, and not against its completeness") {
  Mesh mesh;
  add_square(mesh, 1, 0);
  add_square(mesh, 0.5f, 0.5f, 3);  // a fifth of all surface
  const auto s = score_surface(mesh, Pose::Identity(), Floor(), seen_floor(1), Workers(1));
  CHECK(s.accuracy.median_mm == Approx(0).margin(1e-6));
  CHECK(s.precision() == Approx(0.8).margin(0.005));
  CHECK(s.accuracy.mean_mm == Approx(100).epsilon(0.03));
  CHECK(s.recall() == 1);
}

TEST_CASE("a map in a frame of its own is moved onto the true surface") {
  Twist xi;
  xi << 1, -2, 3, 0.5, 1.5, -0.4;
  const Pose T_map_world = se3_exp(xi);
  Mesh mesh;
  add_square(mesh, 1, 0);
  for (auto& p : mesh.position) p = (T_map_world * p.cast<double>()).cast<float>();
  const auto s = score_surface(mesh, T_map_world.inverse(), Floor(), seen_floor(1), Workers(1));
  CHECK(s.accuracy.median_mm < 1e-3);
  CHECK(s.completeness.mean_mm < 1e-3);
}

TEST_CASE("samples lie on the surface, as many an area everywhere, and are the same ones each time") {
  Mesh mesh;
  add_square(mesh, 1, 0);
  add_square(mesh, 2, 1, 5);
  const auto points = sample_surface(mesh, 20000);
  REQUIRE(points.size() == 20000);
  double lower = 0, left = 0;
  for (const auto& p : points) {
    CHECK((p.z() == 0 || p.z() == Approx(1)));
    lower += p.z() < 0.5f;
    left += p.z() > 0.5f && p.x() < 6;
  }
  CHECK(lower / 20000 == Approx(0.2).margin(0.01));
  CHECK(left / 20000 == Approx(0.4).margin(0.01));
  CHECK(sample_surface(mesh, 20000)[777] == points[777]);
}

TEST_CASE("a map without faces is its vertices, one without anything reaches nothing") {
  Mesh cloud;
  cloud.position = {{0, 0, 0.01f}, {1, 0, 0.03f}};
  const auto s = score_surface(cloud, Pose::Identity(), Floor(), {{0, 0, 0}, {1, 0, 0}, {1, 0.04f, 0}}, Workers(1));
  CHECK(s.accuracy.points == 2);
  CHECK(s.accuracy.mean_mm == Approx(20));
  CHECK(s.completeness.mean_mm == Approx((10 + 30 + 50) / 3.0));
  const auto none = score_surface({}, Pose::Identity(), Floor(), {{0, 0, 0}}, Workers(1));
  CHECK(none.accuracy.points == 0);
  CHECK(none.precision() == 0);
  CHECK(std::isinf(none.completeness.median_mm));
  CHECK(none.f_score() == 0);
}

TEST_CASE("the numbers of a surface do not depend on the number of threads") {
  Mesh mesh;
  add_square(mesh, 1, 0.004f);
  const auto one = score_surface(mesh, Pose::Identity(), Floor(), seen_floor(2), Workers(1));
  const auto four = score_surface(mesh, Pose::Identity(), Floor(), seen_floor(2), Workers(4));
  CHECK(one.accuracy.mean_mm == four.accuracy.mean_mm);
  CHECK(one.completeness.mean_mm == four.completeness.mean_mm);
}
