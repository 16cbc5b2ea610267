#include <catch2/catch.hpp>
#include <set>

#include "modules/maps/ppm/chunk_edit.hpp"

using namespace ppm;

TEST_CASE("texel indices count through the triangular grid without gaps") {
  for (std::uint32_t n = 1; n <= 64; ++n) {
    std::uint32_t expected = 0;
    for (std::uint32_t i = 0; i <= n; ++i)
      for (std::uint32_t j = 0; i + j <= n; ++j) REQUIRE(texel_index(n, i, j) == expected++);
    REQUIRE(expected == texel_count(n));
  }
}

TEST_CASE("the nearest texel is the nearest by brute force on an equilateral face") {
  const Eigen::Vector2f a(0, 0), b(1, 0), c(0.5f, std::sqrt(0.75f));
  auto at = [&](float u, float v) -> Eigen::Vector2f { return (1 - u - v) * a + u * b + v * c; };
  for (std::uint32_t n : {1u, 2u, 5u, 13u})
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; i + j <= 40; ++j) {
        const float u = static_cast<float>(i) / 40, v = static_cast<float>(j) / 40;
        float best = 1e9f;
        for (std::uint32_t x = 0; x <= n; ++x)
          for (std::uint32_t y = 0; x + y <= n; ++y)
            best = std::min(best, (at(static_cast<float>(x) / n, static_cast<float>(y) / n) - at(u, v)).norm());
        const auto found = nearest_texel(n, u, v);
        REQUIRE(found < texel_count(n));
        float distance = -1;
        for (std::uint32_t x = 0; x <= n; ++x)
          for (std::uint32_t y = 0; x + y <= n; ++y)
            if (texel_index(n, x, y) == found)
              distance = (at(static_cast<float>(x) / n, static_cast<float>(y) / n) - at(u, v)).norm();
        REQUIRE(distance == Approx(best).margin(1e-5));
      }
}

TEST_CASE("barycentric coordinates slightly outside a face still name one of its texels") {
  for (float u : {-0.01f, 0.0f, 0.5f, 1.0f, 1.01f})
    for (float v : {-0.01f, 0.0f, 0.5f, 1.0f, 1.01f}) CHECK(nearest_texel(7, u, v) < texel_count(7));
  CHECK(nearest_texel(7, 0, 0) == texel_index(7, 0, 0));
  CHECK(nearest_texel(7, 1, 0) == texel_index(7, 7, 0));
  CHECK(nearest_texel(7, 0, 1) == texel_index(7, 0, 7));
}

TEST_CASE("no two geometries get the same id") {
  std::set<std::uint64_t> ids;
  for (int i = 0; i < 1000; ++i) ids.insert(next_geometry_id());
  CHECK(ids.size() == 1000);
  CHECK(ids.count(0) == 0);
}

TEST_CASE("inserting vertices keeps ids ascending and faces on their vertices") {
  Geometry geometry;
  Texels texels;
  auto position = [](std::uint32_t id) {
    return Eigen::Vector3f(static_cast<float>(id), static_cast<float>(id * id), 1);
  };
  auto insert = [&](std::vector<std::uint32_t> ids) {
    std::vector<NewVertex> vertices;
    for (auto id : ids) vertices.push_back({id, position(id)});
    insert_vertices(geometry, vertices);
  };
  insert({10, 20, 30});
  const std::vector<float> zero(3, 0.0f);
  const std::vector<NewFace> face{{{10, 20, 30}, 1, {}, zero, zero}};
  append_faces(geometry, texels, face);
  insert({5, 15, 25, 40});
  CHECK(geometry.vertex_id == std::vector<std::uint32_t>{5, 10, 15, 20, 25, 30, 40});
  for (std::size_t v = 0; v < geometry.vertex_id.size(); ++v)
    CHECK(geometry.position[v] == position(geometry.vertex_id[v]));
  CHECK(geometry.face[0] == std::array<std::uint32_t, 3>{1, 3, 5});
  drop_unused_vertices(geometry);
  CHECK(geometry.vertex_id == std::vector<std::uint32_t>{10, 20, 30});
  CHECK(geometry.face[0] == std::array<std::uint32_t, 3>{0, 1, 2});
}
