#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/error.hpp"
#include "modules/prediction/embree_scenes.hpp"
#include "tests/support/mesh_map.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

std::shared_ptr<const PpmMap> floor_of_chunks() {
  PpmSettings settings;
  settings.cell_size_m = 0.5;
  return make_map(height_field(12, 1.f, [](float x, float y) { return 0.25f + 0.1f * std::sin(x + y); }), settings);
}

// The same map with the first face of chunk c removed.
std::shared_ptr<const PpmMap> without_a_face(std::shared_ptr<const PpmMap> map, std::uint32_t c) {
  PpmEdit edit(std::move(map));
  edit.remove_face(c, 0);
  return edit.commit();
}

std::shared_ptr<const PpmMap> with_other_texels(std::shared_ptr<const PpmMap> map, std::uint32_t c) {
  PpmEdit edit(std::move(map));
  edit.texels(c).mean[0] = 0.5f;
  return edit.commit();
}

std::size_t non_empty(const PpmMap& map) {
  std::size_t n = 0;
  for (const auto& chunk : map.table().chunks()) n += !chunk.geometry->face.empty();
  return n;
}

}  // namespace

TEST_CASE("maps share the scenes of the chunks whose shape they share, whatever their texels") {
  Workers workers(2);
  EmbreeScenes scenes({});
  const auto a = floor_of_chunks();
  const auto b = with_other_texels(a, 1);
  const auto c = without_a_face(a, 2);
  const std::size_t n = non_empty(*a);
  REQUIRE(n > 8);

  scenes.update({a.get()}, workers);
  CHECK(scenes.size() == n);
  CHECK(scenes.built() == n);
  scenes.update({a.get(), b.get()}, workers);
  CHECK(scenes.size() == n);
  CHECK(scenes.built() == 0);
  CHECK(scenes.of(*a) == scenes.of(*b));
  scenes.update({a.get(), b.get(), c.get()}, workers);
  CHECK(scenes.built() >= 1);
  CHECK(scenes.size() == n + scenes.built());
  for (std::uint32_t i = 0; i < a->table().size(); ++i)
    CHECK((scenes.of(*a)[i] == scenes.of(*c)[i]) == (a->table()[i].geometry->id == c->table()[i].geometry->id));
}

TEST_CASE("scenes that no map uses any more are dropped, with their memory") {
  Workers workers(1);
  EmbreeScenes scenes({});
  auto map = floor_of_chunks();
  scenes.update({map.get()}, workers);
  const std::size_t size = scenes.size();
  const std::int64_t bytes = scenes.bytes();
  CHECK(bytes > 0);
  for (int i = 0; i < 20; ++i) {
    map = without_a_face(std::move(map), static_cast<std::uint32_t>(i) % 4);
    scenes.update({map.get()}, workers);
    CHECK(scenes.size() <= size);
  }
  CHECK(scenes.bytes() <= bytes);
  scenes.update({}, workers);
  CHECK(scenes.size() == 0);
  CHECK(scenes.bytes() < bytes / 10);
}

TEST_CASE("an emptied chunk has no scene, and asking for an unknown map is an error") {
  Workers workers(1);
  EmbreeScenes scenes({});
  const TriangleMesh one{{{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}, {{0, 1, 2}}};
  const auto map = make_map(one);
  const auto empty = without_a_face(map, 0);
  scenes.update({empty.get()}, workers);
  REQUIRE(scenes.of(*empty).size() == 1);
  CHECK(scenes.of(*empty)[0] == nullptr);
  CHECK_THROWS_AS(scenes.of(*map), InternalError);
}

TEST_CASE("objects with equal options share scenes, for as long as one of them uses them") {
  Workers workers(1);
  EmbreeScenes first({}), second({}), other({.robust = false});
  auto map = floor_of_chunks();
  first.update({map.get()}, workers);
  second.update({map.get()}, workers);
  other.update({map.get()}, workers);
  CHECK(first.built() == non_empty(*map));
  CHECK(second.built() == 0);
  CHECK(second.of(*map) == first.of(*map));
  CHECK(other.built() == non_empty(*map));
  first.update({}, workers);
  CHECK(second.of(*map)[0]->handle() != nullptr);
  first.update({map.get()}, workers);
  CHECK(first.built() == 0);
  first.update({}, workers);
  second.update({}, workers);
  first.update({map.get()}, workers);
  CHECK(first.built() == non_empty(*map));
}
