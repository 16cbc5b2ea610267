#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "framework/core/rng.hpp"
#include "framework/slam/nearest_triangle.hpp"

using namespace ppm;
using Triangle = std::array<Eigen::Vector3f, 3>;

TEST_CASE("distance to a triangle: over its face, beside an edge, beyond a corner, in its plane") {
  const Triangle t{Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(4, 0, 0), Eigen::Vector3f(0, 3, 0)};
  CHECK(squared_distance({1, 1, 2}, t) == Approx(4));
  CHECK(squared_distance({1, 1, -2}, t) == Approx(4));
  CHECK(squared_distance({1, 1, 0}, t) == Approx(0).margin(1e-12));
  CHECK(squared_distance({2, -1, 1}, t) == Approx(2));
  CHECK(squared_distance({-3, -4, 0}, t) == Approx(25));
  CHECK(squared_distance({6, 0, 1}, t) == Approx(5));
  CHECK(squared_distance({2 + 0.6f, 1.5f + 0.8f, 0}, t) == Approx(1));  // off the middle of the long edge, along its normal
}

TEST_CASE("triangles that are a line or a point have a distance too") {
  const Eigen::Vector3f a(0, 0, 0), b(2, 0, 0);
  CHECK(squared_distance({1, 1, 0}, {a, b, a}) == Approx(1));
  CHECK(squared_distance({3, 0, 0}, {a, b, b}) == Approx(1));
  CHECK(squared_distance({0, 3, 4}, {a, a, a}) == Approx(25));
}

TEST_CASE("the tree finds what a look at every triangle finds") {
  Rng rng(1, 0, 0, 0);
  auto point = [&](double size) {
    return Eigen::Vector3f(Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).cast<float>() *
                           static_cast<float>(size));
  };
  for (std::size_t count : {1, 4, 5, 300}) {
    std::vector<Eigen::Vector3f> position;
    std::vector<NearestTriangle::Face> faces;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Eigen::Vector3f center = point(1);
      for (int k = 0; k < 3; ++k) position.push_back(center + point(0.1));
      faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const NearestTriangle tree(position, faces);
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3f p = point(1.5);
      float best = std::numeric_limits<float>::infinity();
      for (const auto& [a, b, c] : faces) best = std::min(best, squared_distance(p, {position[a], position[b], position[c]}));
      CHECK(tree.distance(p) == Approx(std::sqrt(best)));
    }
  }
}

TEST_CASE("no triangle is infinitely far, many in one place are one") {
  CHECK(NearestTriangle({}, {}).empty());
  CHECK(std::isinf(NearestTriangle({}, {}).distance({0, 0, 0})));
  const NearestTriangle same({{1, 0, 0}}, std::vector<NearestTriangle::Face>(1000, {0, 0, 0}));
  CHECK(same.distance({0, 0, 0}) == 1);
}
