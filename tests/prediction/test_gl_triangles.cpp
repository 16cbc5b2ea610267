#include <catch2/catch.hpp>

#include "modules/prediction/face_numbers.hpp"
#include "modules/prediction/gl_triangles.hpp"
#include "tests/support/mesh_map.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

std::shared_ptr<const PpmMap> wave(double cell_m) {
  PpmSettings settings;
  settings.cell_size_m = cell_m;
  return make_map(height_field(20, 1.f, [](float x, float y) { return 1.5f + 0.1f * x * y; }), settings);
}

}  // namespace

TEST_CASE("each face is drawn with its corners and winding, and its last vertex stands for it alone") {
  const auto check = [](const Geometry& geometry) {
    const GlTriangles triangles(geometry);
    REQUIRE(triangles.face.size() == geometry.face.size());
    for (std::uint32_t f = 0; f < geometry.face.size(); ++f) {
      const auto& drawn = triangles.face[f];
      CHECK(drawn[2] == f);
      int turns = 0;  // of the corners, that give the same triangle
      for (std::size_t turn = 0; turn < 3; ++turn) {
        bool same = true;
        for (std::size_t k = 0; k < 3; ++k)
          same &= triangles.position[drawn[k]] == geometry.position[geometry.face[f][(k + turn) % 3]];
        turns += same;
      }
      CHECK(turns == 1);
    }
    // Hardly more vertices are shaded than there are faces.
    CHECK(triangles.position.size() <= geometry.face.size() + geometry.position.size() / 4);
  };
  for (double cell_m : {0.4, 5.0}) {
    const auto map = wave(cell_m);
    for (const auto& chunk : map->table().chunks()) check(*chunk.geometry);
  }
}

TEST_CASE("faces are counted through all chunks, and a number tells its chunk whatever is guessed") {
  auto map = wave(0.4);
  PpmEdit edit(map);
  for (std::uint32_t f = 0; f < map->table()[3].geometry->face.size(); ++f) edit.remove_face(3, f);
  map = edit.commit();
  const FaceNumbers numbers(*map);
  std::uint32_t next = 0;
  const auto chunks = static_cast<std::uint32_t>(map->table().size());
  REQUIRE(chunks > 9);
  REQUIRE(map->table()[3].geometry->face.empty());
  for (std::uint32_t c = 0; c < chunks; ++c) {
    CHECK(numbers.first(c) == next);
    for (std::uint32_t f = 0; f < map->table()[c].geometry->face.size(); ++f, ++next)
      for (std::uint32_t guess : {0u, c, chunks - 1}) CHECK(numbers.chunk_of(next, guess) == c);
  }
}
