// Storage, edits and checkpoints of point maps.
#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "framework/core/rng.hpp"
#include "modules/maps/points/point_codec.hpp"
#include "tests/points/points.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

Eigen::Vector3f random_direction(Rng& rng) {
  Eigen::Vector3f n;
  for (int k = 0; k < 3; ++k) n[k] = static_cast<float>(rng.normal());
  return n.normalized();
}

std::vector<SurfacePoint> random_points(std::size_t n, float extent, std::uint32_t seed) {
  Rng rng(seed, 0, 0, purpose_key("points"));
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Vector3f p;
    for (int k = 0; k < 3; ++k) p[k] = extent * (2 * static_cast<float>(rng.uniform()) - 1);
    points.push_back(surface_point(p, random_direction(rng), 0.02f));
  }
  return points;
}

std::vector<MapHandle> there_and_back(const std::vector<MapHandle>& maps) {
  TempFolder folder;
  std::vector<const Map*> plain;
  for (const auto& map : maps) plain.push_back(map.get());
  RecordFileWriter out(folder / "maps", "PPMTEST\n");
  PointCodec().save(plain, out);
  out.commit();
  RecordFileReader in(folder / "maps", "PPMTEST\n", "maps");
  auto back = PointCodec().load(in);
  in.finish("the maps");
  return back;
}

const PointMap& points_of(const MapHandle& map) {
  return static_cast<const PointMap&>(*map);
}

std::int64_t memory_of(const std::vector<MapHandle>& maps) {
  std::unordered_set<const void*> seen;
  std::int64_t bytes = 0;
  for (const auto& map : maps) bytes += map->account(seen);
  return bytes;
}

}  // namespace

TEST_CASE("a normal in four bytes is the normal to 1e-4 rad") {
  Rng rng(1, 0, 0, purpose_key("normals"));
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector3f n = random_direction(rng), back = UnitNormal(n).vector();
    CHECK(back.norm() == Approx(1).epsilon(1e-5));
    CHECK(n.cross(back).norm() < 1e-4f);
    CHECK(n.dot(back) > 0);
  }
  for (int axis = 0; axis < 3; ++axis)
    for (float sign : {-1.0f, 1.0f}) CHECK(UnitNormal(sign * Eigen::Vector3f::Unit(axis)).vector() == sign * Eigen::Vector3f::Unit(axis));
}

TEST_CASE("voxels and tiles of places on both sides of zero") {
  const PointMap map(0.1);
  CHECK(map.voxel_of({0.05f, -0.05f, 3.15f}) == Cell(0, -1, 31));
  CHECK(PointMap::tile_of({0, 31, 32}) == Cell(0, 0, 1));
  CHECK(PointMap::tile_of({-1, -32, -33}) == Cell(-1, -1, -2));
  CHECK_THROWS_AS(PointMap(0), InternalError);
}

TEST_CASE("an edit finds the nearest point that agrees, as brute force does") {
  const auto points = random_points(4000, 0.4f, 2);
  PointEdit edit(with(std::make_shared<PointMap>(0.05), points));
  Rng rng(3, 0, 0, purpose_key("queries"));
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    Eigen::Vector3f p;
    for (int k = 0; k < 3; ++k) p[k] = 0.9f * (static_cast<float>(rng.uniform()) - 0.5f);
    const Eigen::Vector3f n = random_direction(rng);
    float nearest = 0.05f * 0.05f;
    bool any = false;
    for (const auto& q : points) {
      const float square = (q.position - p).squaredNorm();
      if (square < nearest && q.normal.vector().dot(n) >= 0.5f) nearest = square, any = true;
    }
    const SurfacePoint* at = edit.find(p, n, 0.05f, 0.5f);
    REQUIRE((at != nullptr) == any);
    if (at) CHECK((at->position - p).squaredNorm() == nearest);
    found += any;
  }
  CHECK(found > 200);
}

TEST_CASE("points are added, changed and removed, a parent never changes") {
  const auto points = random_points(3000, 1.5f, 4);
  const auto parent = with(std::make_shared<PointMap>(0.02), points);
  CHECK(parent->stats().vertices == 3000);
  const auto before = points_digest(*parent);
  PointEdit edit(parent);
  edit.points(0).front().position.x() += 0.001f;
  edit.remove({{1, 0}, {1, 2}, {3, 1}});
  edit.add(surface_point({10, 10, 10}, {0, 0, 1}, 0.02f));
  const auto child = edit.commit();
  CHECK(points_digest(*parent) == before);
  CHECK(child->stats().vertices == 2998);
  CHECK(child->table().size() == parent->table().size() + 1);
  CHECK(child->table()[1].tile->points.size() == parent->table()[1].tile->points.size() - 2);
  CHECK(child->table()[1].tile->points[0].position == parent->table()[1].tile->points[1].position);
  for (std::size_t tile = 0; tile < parent->table().size(); ++tile) {
    const bool written = tile == 0 || tile == 1 || tile == 3;
    CHECK((child->table()[tile].tile == parent->table()[tile].tile) == !written);
    CHECK((child->table()[tile].tile->id == parent->table()[tile].tile->id) == !written);
  }
}

TEST_CASE("the only handle's memory is written again, and one of two is not") {
  auto map = with(std::make_shared<PointMap>(0.02), random_points(100, 0.3f, 5));
  const auto* memory = map.get();
  PointEdit edit(std::move(map));
  auto again = edit.commit();
  CHECK(again.get() == memory);
  const auto second = again;
  PointEdit other(std::move(again));
  CHECK(other.commit().get() != memory);
}

TEST_CASE("memory is counted to the last point, and once where it is shared") {
  const auto parent = with(std::make_shared<PointMap>(0.02), random_points(3000, 1.5f, 6));
  std::int64_t least = 0;
  for (const auto& chunk : parent->table().chunks())
    least += static_cast<std::int64_t>(sizeof(PointTile) + 32 * chunk.tile->points.size());
  CHECK(parent->stats().bytes >= least);
  CHECK(parent->stats().bytes < least + 200 * static_cast<std::int64_t>(parent->table().size()) + 1000);
  PointEdit edit(parent);
  edit.points(0);
  const auto child = edit.commit();
  const auto own = memory_of({parent, child}) - memory_of({parent});
  CHECK(own >= child->table()[0].tile->bytes());
  CHECK(own < child->stats().bytes / 2);
}

TEST_CASE("point maps come back from a checkpoint with their content and what they share") {
  const auto parent = with(std::make_shared<PointMap>(0.02), random_points(2000, 1.0f, 7));
  PointEdit edit(parent);
  edit.points(2).front().hits = 9;
  const std::vector<MapHandle> maps{parent, edit.commit(), std::make_shared<PointMap>(0.05)};
  const auto back = there_and_back(maps);
  REQUIRE(back.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(points_digest(*back[i]) == points_digest(*maps[i]));
  CHECK(memory_of(back) == memory_of(maps));
  CHECK(points_of(back[0]).table().cells() == points_of(back[1]).table().cells());
  for (std::size_t tile = 0; tile < parent->table().size(); ++tile)
    CHECK((points_of(back[0]).table()[tile].tile == points_of(back[1]).table()[tile].tile) == (tile != 2));
}

TEST_CASE("a damaged record of point maps is refused") {
  TempFolder folder;
  auto load = [&](const std::vector<std::uint32_t>& tiles, double spacing) {
    RecordFileWriter out(folder / "maps", "PPMTEST\n");
    RecordWriter counts, map;
    for (std::uint64_t n : {0, 0, 1}) counts.add(n);
    map.add(spacing);
    map.add(0xffffffffu);
    map.add(tiles);
    out.write(counts);
    out.write(map);
    out.commit();
    RecordFileReader in(folder / "maps", "PPMTEST\n", "maps");
    return PointCodec().load(in);
  };
  CHECK(load({}, 0.02).size() == 1);
  CHECK_THROWS_AS(load({0}, 0.02), DataError);
  CHECK_THROWS_AS(load({}, 0.0), DataError);
}

TEST_CASE("the mesh of a point map is a disc a point, towards its normal") {
  const auto map = with(std::make_shared<PointMap>(0.02), {surface_point({1, 2, 3}, {0, 0, -1}, 0.05f)});
  const Mesh mesh = map->mesh(Surface::displaced);
  REQUIRE(mesh.position.size() == 6);
  REQUIRE(mesh.face.size() == 4);
  for (const auto& p : mesh.position) CHECK((p - Eigen::Vector3f(1, 2, 3)).norm() == Approx(0.05).epsilon(1e-3));
  for (const auto& f : mesh.face) {
    const Eigen::Vector3f n = (mesh.position[f[1]] - mesh.position[f[0]]).cross(mesh.position[f[2]] - mesh.position[f[0]]);
    CHECK(n.normalized().dot(Eigen::Vector3f(0, 0, -1)) == Approx(1));
  }
}
