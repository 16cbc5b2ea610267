// The OctoMap behind the framework's own interface: sharing, digest, checkpoints, mesh, and the update against plain sums.
#include <catch2/catch.hpp>
#include <map>
#include <octomap/OcTree.h>

#include "framework/core/error.hpp"
#include "modules/maps/octomap/octomap_codec.hpp"
#include "modules/maps/octomap/octomap_map.hpp"
#include "tests/support/box_images.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;

namespace {

std::string digest_of(const Map& map) {
  Digest digest;
  map.digest(digest);
  return digest.hex();
}

void insert_view(OctomapMap& map, std::size_t i) {
  const auto view = test::box_views()[i];
  map.insert(test::box_image(test::box_camera(), view), view, {});
}

}  // namespace

TEST_CASE("a copy is edited apart from what it was copied from") {
  OctomapMap map(0.1, 0.5);
  insert_view(map, 0);
  const auto before = digest_of(map);
  OctomapMap copy(map);
  CHECK(digest_of(copy) == before);
  insert_view(copy, 1);
  CHECK(digest_of(map) == before);
  CHECK(digest_of(copy) != before);
  std::unordered_set<const void*> seen;
  CHECK(map.account(seen) == map.stats().bytes);
  CHECK(copy.account(seen) == copy.stats().bytes);  // nothing is shared
  CHECK(copy.account(seen) == 0);
}

TEST_CASE("bytes are those of nodes and arrays of children") {
  OctomapMap map(0.1, 0.5);
  insert_view(map, 0);
  std::size_t nodes = 0, inner = 0;
  for (auto it = map.tree().begin_tree(); it != map.tree().end_tree(); ++it) {
    ++nodes;
    inner += map.tree().nodeHasChildren(&*it);
  }
  const auto bytes = static_cast<std::int64_t>(nodes * sizeof(octomap::OcTreeNode) + inner * 8 * sizeof(void*));
  CHECK(map.stats().bytes > bytes);
  CHECK(map.stats().bytes < bytes + 2048);
}

TEST_CASE("cells that rays end in take the log odds of a hit, image by image, up to the clamp") {
  OctomapMap map(0.07, 0.5);  // no wall at a border of cells
  const auto view = test::box_views()[0];
  auto frame = test::box_image(test::box_camera(), view);
  OctomapInsertion how;
  how.sensor = {0.8, 0.3, 0.1, 0.95};
  const double hit = std::log(0.8 / 0.2), most = std::log(0.95 / 0.05);
  for (int images = 1; images <= 4; ++images) {
    map.insert(frame, view, how);
    for (int i = 0; i < frame.camera.pixels(); i += 37) {
      const Eigen::Vector3d p =
          view * (frame.camera.ray(i % frame.camera.cols, i / frame.camera.cols) * frame.depth[static_cast<std::size_t>(i)]);
      const auto* node = map.tree().search(p.x(), p.y(), p.z());
      REQUIRE(node);
      CHECK(node->getLogOdds() == Approx(std::min(images * hit, most)).margin(1e-3));
    }
  }
}

TEST_CASE("what has no return or is beyond the range leaves no hit") {
  OctomapMap map(0.1, 0.5);
  const auto view = test::box_views()[0];
  auto frame = test::box_image(test::box_camera(), view);
  OctomapInsertion how;
  how.range_most_m = 1;
  map.insert(frame, view, how);
  CHECK(map.mesh(Surface::base).face.empty());
  const auto bytes = map.stats().bytes;
  for (auto& depth : frame.depth) depth = std::numeric_limits<float>::quiet_NaN();
  map.insert(frame, view, {});
  CHECK(map.stats().bytes == bytes);
}

TEST_CASE("octrees come back from a checkpoint as they were") {
  auto empty = std::make_shared<OctomapMap>(0.2, 0.6), map = std::make_shared<OctomapMap>(0.1, 0.5);
  insert_view(*map, 2);
  test::TempFolder folder;
  {
    RecordFileWriter file(folder / "maps", "octotest");
    OctomapCodec().save({empty.get(), map.get()}, file);
    file.commit();
  }
  RecordFileReader file(folder / "maps", "octotest", "a test");
  const auto loaded = OctomapCodec().load(file);
  file.finish("the last octree");
  REQUIRE(loaded.size() == 2);
  CHECK(digest_of(*loaded[0]) == digest_of(*empty));
  CHECK(digest_of(*loaded[1]) == digest_of(*map));
  CHECK(loaded[1]->stats().bytes == map->stats().bytes);
}

TEST_CASE("a record that holds no octree is refused") {
  RecordWriter out;
  out.add(0.1);
  out.add(0.5);
  out.add(std::string("\x01\x02"));
  RecordReader in(out.bytes(), "file", "octree 0");
  CHECK_THROWS_AS(load_octomap(in), DataError);
}

TEST_CASE("the mesh is the boundary between occupied and free cells, wound towards the free ones") {
  OctomapMap map(0.1, 0.5);
  for (std::size_t i = 0; i < 8; ++i) insert_view(map, i);
  const auto mesh = map.mesh(Surface::base);
  REQUIRE(mesh.face.size() > 1000);
  CHECK(mesh.normal.size() == mesh.position.size());
  std::size_t outwards = 0;
  for (const auto& f : mesh.face) {
    const Eigen::Vector3f centre = (mesh.position[f[0]] + mesh.position[f[1]] + mesh.position[f[2]]) / 3;
    const Eigen::Vector3f normal =
        (mesh.position[f[1]] - mesh.position[f[0]]).cross(mesh.position[f[2]] - mesh.position[f[0]]);
    CHECK(normal.norm() == Approx(0.01).epsilon(1e-3));  // half a square of 10 cm, twice
    const Eigen::Vector3d inside = (centre + 0.05f * normal.normalized()).cast<double>();
    const auto* node = map.tree().search(inside.x(), inside.y(), inside.z());
    outwards += node && !map.tree().isNodeOccupied(node);
  }
  CHECK(outwards == mesh.face.size());
}
