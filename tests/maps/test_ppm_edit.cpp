#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "framework/core/parallel.hpp"
#include "tests/support/ppm_maps.hpp"

using namespace ppm;
using test::digest_of;
using test::height_field;

namespace {

PpmSettings small_cells() {
  PpmSettings settings;
  settings.cell_size_m = 0.5;
  settings.texel_size_m = 0.05;
  return settings;
}

}  // namespace

TEST_CASE("a height field over several cells keeps every invariant") {
  const auto map = height_field(16, 12, 0.1f, small_cells(),
                                [](float x, float y) { return 0.1f * std::sin(5 * x) * std::cos(4 * y); });
  map->check();
  const auto stats = map->stats();
  CHECK(stats.vertices == 17 * 13);
  CHECK(stats.faces == 2 * 16 * 12);
  CHECK(stats.chunks > 6);
  CHECK(map->vertex_ids() == 17 * 13);
}

TEST_CASE("an edit of a shared map leaves the other handle as it was") {
  const auto parent = height_field(16, 12, 0.1f, small_cells());
  const auto before = digest_of(*parent);
  PpmEdit edit(parent);
  edit.texels(0).mean[3] = 0.25f;
  edit.remove_face(1, 0);
  edit.move_vertex(2, 1, parent->table()[2].geometry->position[1] + Eigen::Vector3f(0, 0, 0.05f));
  const auto child = edit.commit();
  child->check();
  CHECK(digest_of(*parent) == before);
  CHECK(digest_of(*child) != before);
  CHECK(child->table()[0].texels->mean[3] == 0.25f);
  CHECK(parent->table()[0].texels->mean[3] == 0.0f);
  CHECK(child->stats().faces == parent->stats().faces - 1);
}

TEST_CASE("only what is written is cloned") {
  const auto parent = height_field(20, 20, 0.1f, small_cells());
  PpmEdit edit(parent);
  edit.texels(0).mean[0] = 1;
  const auto child = edit.commit();
  for (std::size_t c = 0; c < child->table().size(); ++c) {
    CHECK(child->table()[c].geometry == parent->table()[c].geometry);
    CHECK((child->table()[c].texels == parent->table()[c].texels) == (c != 0));
  }
  std::unordered_set<const void*> seen;
  const auto alone = parent->account(seen), added = child->account(seen);
  CHECK(alone > added);
  CHECK(added < child->table()[0].texels->bytes() + 4096);
  CHECK(child->account(seen) == 0);
}

TEST_CASE("the only handle to a map gives its memory to the session") {
  auto map = height_field(4, 4, 0.1f, small_cells());
  const PpmMap* address = map.get();
  PpmEdit edit(std::move(map));
  edit.texels(0).mean[0] = 1;
  CHECK(edit.commit().get() == address);
}

TEST_CASE("copies of a map are edited from several threads at once, with the same results as one after the other") {
  const Workers workers(4);
  auto edited = [](std::shared_ptr<const PpmMap> map, std::size_t i) {
    PpmEdit edit(std::move(map));
    for (std::uint32_t c = 0; c < edit.map().table().size(); ++c)
      edit.texels(c).mean[i] += 0.01f * static_cast<float>(i);
    edit.remove_face(static_cast<std::uint32_t>(i % 4), static_cast<std::uint32_t>(i % 5));
    edit.move_vertex(1, 2, edit.map().table()[1].geometry->position[2] + Eigen::Vector3f(0, 0, 0.001f));
    return edit.commit();
  };
  std::vector<std::shared_ptr<const PpmMap>> maps(24, height_field(16, 12, 0.1f, small_cells())), serial = maps;
  for (int round = 0; round < 3; ++round) {
    workers.for_each(maps.size(), [&](std::size_t i, int) { maps[i] = edited(std::move(maps[i]), i); });
    for (std::size_t i = 0; i < serial.size(); ++i) serial[i] = edited(std::move(serial[i]), i);
    for (std::size_t i = 0; i < maps.size(); ++i) REQUIRE(digest_of(*maps[i]) == digest_of(*serial[i]));
  }
}

TEST_CASE("a commit without changes shares every chunk") {
  const auto map = height_field(8, 8, 0.1f, small_cells());
  PpmEdit edit(map);
  const auto same = edit.commit();
  CHECK(digest_of(*same) == digest_of(*map));
  for (std::size_t c = 0; c < map->table().size(); ++c) CHECK(same->table()[c].geometry == map->table()[c].geometry);
}

TEST_CASE("removing a face keeps the other faces' texels and evidence with them, and drops lone vertices") {
  auto map = height_field(1, 1, 0.4f, small_cells());
  REQUIRE(map->table().size() == 1);
  {
    PpmEdit edit(std::move(map));
    auto& texels = edit.texels(0);
    for (std::size_t t = 0; t < texels.mean.size(); ++t) texels.mean[t] = static_cast<float>(t);
    texels.evidence = {{1, 2}, {3, 4}};
    map = edit.commit();
  }
  const auto first = map->table()[0].geometry->first_texel[1];
  PpmEdit edit(map);
  edit.remove_face(0, 0);
  edit.remove_face(0, 0);  // saying it twice is saying it once
  const auto left = edit.commit();
  left->check();
  const auto& chunk = left->table()[0];
  REQUIRE(chunk.geometry->face.size() == 1);
  CHECK(chunk.geometry->vertex_id == std::vector<std::uint32_t>{0, 2, 3});
  CHECK(chunk.texels->evidence[0].hits == 3);
  CHECK(chunk.texels->mean.front() == static_cast<float>(first));
  CHECK(chunk.geometry->open_edge.size() == 3);
}

TEST_CASE("a vertex on the border of cells moves in every chunk, and its neighbours' normals follow") {
  const auto map = height_field(10, 10, 0.1f, small_cells());
  const std::uint32_t id = 5 * 11 + 5;  // at (0.5, 0.5, 0), where cells meet
  PpmEdit edit(map);
  int copies = 0;
  for (std::uint32_t c = 0; c < map->table().size(); ++c) {
    const auto v = map->table()[c].geometry->find_vertex(id);
    if (v == Geometry::kNoVertex) continue;
    if (copies++ == 0) edit.move_vertex(c, v, Eigen::Vector3f(0.5f, 0.5f, 0.05f));
  }
  REQUIRE(copies > 1);
  const auto moved = edit.commit();
  moved->check();
  for (const auto& chunk : moved->table().chunks()) {
    const auto v = chunk.geometry->find_vertex(id);
    if (v != Geometry::kNoVertex) CHECK(chunk.geometry->position[v].z() == 0.05f);
  }
  const auto neighbour = moved->table()[0].geometry->find_vertex(id - 1);
  REQUIRE(neighbour != Geometry::kNoVertex);
  CHECK(moved->table()[0].geometry->normal[neighbour].x() < -0.05f);
}

TEST_CASE("faces stitched on later share vertices with what is there") {
  const auto map = height_field(5, 5, 0.1f, small_cells());  // ends at the border of the cell, x = 0.5
  PpmEdit edit(map);
  const std::uint32_t a = 0 * 6 + 5, b = 1 * 6 + 5;  // (0.5, 0, 0) and (0.5, 0.1, 0)
  edit.use_vertex(a, {0.5f, 0, 0});
  edit.use_vertex(b, {0.5f, 0.1f, 0});
  const auto c = edit.add_vertex({0.6f, 0.05f, 0.1f});
  test::add_flat_face(edit, {a, c, b}, 2, 0.0f, 0.01f);
  const auto grown = edit.commit();
  grown->check();
  CHECK(grown->table().size() == map->table().size() + 1);
  CHECK(grown->stats().vertices == map->stats().vertices + 1);
  const auto& old_chunk = *grown->table()[0].geometry;
  CHECK(old_chunk.normal[old_chunk.find_vertex(a)].x() < 0);  // the new face is part of the old chunk's normal
  CHECK(old_chunk.id != map->table()[0].geometry->id);
}

TEST_CASE("a face long enough to reach over a cell is still found from its far corner") {
  PpmSettings settings;
  settings.cell_size_m = 0.25;
  PpmEdit edit(std::make_shared<PpmMap>(settings));
  const auto a = edit.add_vertex({0, 0, 0}), b = edit.add_vertex({2, 0, 0}), c = edit.add_vertex({0, 2, 0});
  test::add_flat_face(edit, {a, b, c}, 8, 0.0f, 0.01f);
  const auto map = edit.commit();
  map->check();
  CHECK(map->reach() >= 4);
  PpmEdit move(map);
  move.move_vertex(0, 1, {2, 0, 1});
  const auto moved = move.commit();
  moved->check();
  CHECK(moved->table()[0].geometry->position[1] == Eigen::Vector3f(2, 0, 1));
}

TEST_CASE("what would break a map is refused") {
  PpmEdit edit(height_field(2, 2, 0.1f));
  CHECK_THROWS_AS(edit.use_vertex(1000, {0, 0, 0}), InternalError);
  CHECK_THROWS_AS(test::add_flat_face(edit, {0, 1, 2}, 2, 0, 1), InternalError);  // vertices not of this session
  CHECK_THROWS_AS(edit.remove_face(0, 8), InternalError);
  CHECK_THROWS_AS(edit.texels(7), InternalError);
  edit.commit();
  CHECK_THROWS_AS(edit.commit(), InternalError);
}
