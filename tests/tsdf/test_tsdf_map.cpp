// The TSDF behind the framework's own interface: averages against plain sums, sharing of blocks, checkpoints, mesh.
#include <catch2/catch.hpp>

#include "modules/maps/tsdf/tsdf_codec.hpp"
#include "modules/maps/tsdf/tsdf_map.hpp"
#include "tests/support/box_images.hpp"
#include "tests/support/plane_image.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;

namespace {

const Camera kCamera{80, 60, 100, 100, 39.5, 29.5};

std::string digest_of(const Map& map) {
  Digest digest;
  map.digest(digest);
  return digest.hex();
}

void integrate_view(TsdfMap& map, std::size_t i) {
  const auto view = test::box_views()[i];
  map.integrate(test::box_image(test::box_camera(), view), view, 0);
}

std::int64_t shared_bytes(const Map& a, const Map& b) {
  std::unordered_set<const void*> seen;
  return a.stats().bytes + b.stats().bytes - a.account(seen) - b.account(seen);
}

}  // namespace

TEST_CASE("a voxel is the mean of the truncated distances that images gave it") {
  TsdfMap map({0.02, 0.08});
  const double depths[] = {1.00, 1.03, 1.01};
  for (const double z : depths) map.integrate(test::plane_image(kCamera, {0, 0, 1}, z), Pose::Identity(), 0);
  std::vector<float> tsdf, weight;
  int compared = 0;
  for (const auto& [place, block] : map.sorted_blocks()) {
    TsdfMap::read_block(*block, tsdf, weight);
    for (int x = 0, i = 0; x < 16; ++x)
      for (int y = 0; y < 16; ++y)
        for (int z = 0; z < 16; ++z, ++i) {
          const Eigen::Vector3d p = (place * 16 + Eigen::Vector3i(x, y, z)).cast<double>() * 0.02 + Eigen::Vector3d::Constant(0.01);
          const auto pixel = kCamera.project(p);
          if (weight[static_cast<std::size_t>(i)] != 3) continue;
          double sum = 0;
          for (const double d : depths) {
            const auto ray = kCamera.ray(std::round(pixel.x()), std::round(pixel.y()));
            sum += std::min(1.0, (d - p.z()) * ray.norm() / 0.08);
          }
          ++compared;
          CHECK(static_cast<double>(tsdf[static_cast<std::size_t>(i)]) == Approx(sum / 3).margin(2e-3));
        }
  }
  CHECK(compared > 1000);
}

TEST_CASE("a copy shares blocks until it writes them, and is edited apart") {
  TsdfMap map({0.04, 0.16});
  integrate_view(map, 0);
  integrate_view(map, 4);
  const auto before = digest_of(map);
  TsdfMap copy(map);
  const auto blocks = static_cast<std::int64_t>(map.sorted_blocks().size());
  CHECK(shared_bytes(map, copy) > blocks * 4096 * 8);
  integrate_view(copy, 0);
  CHECK(digest_of(map) == before);
  CHECK(digest_of(copy) != before);
  std::int64_t shared = 0;
  for (const auto& a : map.sorted_blocks())
    for (const auto& b : copy.sorted_blocks()) shared += a.second == b.second;
  CHECK(shared > blocks / 4);  // what only the other view saw
  CHECK(shared < blocks);
}

TEST_CASE("bytes are those of voxels and tables") {
  TsdfMap map({0.04, 0.16});
  integrate_view(map, 0);
  const auto voxels = static_cast<std::int64_t>(map.sorted_blocks().size()) * 4096;
  CHECK(map.stats().bytes > voxels * 48);  // Open3D's voxel: place, colour, distance, weight
  CHECK(map.stats().bytes < voxels * 49);
}

TEST_CASE("pixels without a return and beyond the range teach nothing") {
  TsdfMap map({0.04, 0.16});
  auto frame = test::plane_image(kCamera, {0, 0, 1}, 3);
  map.integrate(frame, Pose::Identity(), 2.5);
  CHECK(map.sorted_blocks().empty());
  for (auto& depth : frame.depth) depth = test::kNoReturn;
  map.integrate(frame, Pose::Identity(), 0);
  CHECK(map.sorted_blocks().empty());
}

TEST_CASE("volumes come back from a checkpoint as they were, and share what they shared") {
  auto map = std::make_shared<TsdfMap>(TsdfSettings{0.04, 0.16});
  integrate_view(*map, 0);
  auto copy = std::make_shared<TsdfMap>(*map);
  integrate_view(*copy, 2);
  const TsdfMap empty({0.03, 0.1});
  test::TempFolder folder;
  {
    RecordFileWriter file(folder / "maps", "tsdftest");
    TsdfCodec().save({map.get(), copy.get(), &empty}, file);
    file.commit();
  }
  RecordFileReader file(folder / "maps", "tsdftest", "a test");
  const auto loaded = TsdfCodec().load(file);
  file.finish("the last volume");
  REQUIRE(loaded.size() == 3);
  CHECK(digest_of(*loaded[0]) == digest_of(*map));
  CHECK(digest_of(*loaded[1]) == digest_of(*copy));
  CHECK(digest_of(*loaded[2]) == digest_of(empty));
  CHECK(shared_bytes(*loaded[0], *loaded[1]) == shared_bytes(*map, *copy));
  TsdfMap on(static_cast<const TsdfMap&>(*loaded[0]));
  integrate_view(on, 2);
  CHECK(digest_of(on) == digest_of(*copy));
}

TEST_CASE("the mesh is the wall, wound towards the camera, in an order of its own") {
  TsdfMap map({0.02, 0.08});
  map.integrate(test::plane_image(kCamera, {0, 0, 1}, 1.5), Pose::Identity(), 0);
  const auto mesh = map.mesh(Surface::base);
  REQUIRE(mesh.face.size() > 1000);
  for (const auto& p : mesh.position) CHECK(p.z() == Approx(1.5f).margin(0.01));
  for (const auto& f : mesh.face) {
    const Eigen::Vector3f normal =
        (mesh.position[f[1]] - mesh.position[f[0]]).cross(mesh.position[f[2]] - mesh.position[f[0]]);
    CHECK(normal.z() <= 0);
  }
  CHECK(std::ranges::is_sorted(mesh.face));
}
