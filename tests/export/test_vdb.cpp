// The distance field as OpenVDB reads it back, against distances by brute force.
#include <catch2/catch.hpp>
#include <openvdb/io/Stream.h>
#include <openvdb/math/Proximity.h>
#include <openvdb/openvdb.h>
#include <sstream>

#include "modules/maps/export/vdb.hpp"
#include "tests/export/export_maps.hpp"

using namespace ppm;

namespace {

openvdb::Vec3d vec(const Eigen::Vector3f& p) {
  return {p.x(), p.y(), p.z()};
}

double distance_to(const Mesh& mesh, const openvdb::Vec3d& p) {
  double nearest = 1e9;
  for (const auto& [a, b, c] : mesh.face) {
    openvdb::Vec3d weight;
    const auto on_face =
        openvdb::math::closestPointOnTriangleToPoint(vec(mesh.position[a]), vec(mesh.position[b]), vec(mesh.position[c]), p, weight);
    nearest = std::min(nearest, (on_face - p).length());
  }
  return nearest;
}

}  // namespace

TEST_CASE("a VDB file holds the distance to the described surface and its sigma") {
  const auto map = test::textured_sheet();
  const Mesh mesh = map->mesh(Surface::displaced);
  constexpr double kVoxel = 0.02;
  openvdb::initialize();
  std::istringstream in(to_vdb(mesh, kVoxel));
  const auto grids = openvdb::io::Stream(in).getGrids();
  REQUIRE(grids->size() == 2);
  const auto distance = openvdb::gridPtrCast<openvdb::FloatGrid>((*grids)[0]);
  const auto sigma = openvdb::gridPtrCast<openvdb::FloatGrid>((*grids)[1]);
  CHECK(distance->getName() == "distance");
  CHECK(sigma->getName() == "sigma");
  CHECK(distance->transform().voxelSize().x() == Approx(kVoxel));
  REQUIRE(distance->activeVoxelCount() > 1000);
  REQUIRE(sigma->activeVoxelCount() == distance->activeVoxelCount());
  const auto [least, most] = std::minmax_element(mesh.variance.begin(), mesh.variance.end());
  int looked_at = 0;
  double too_far = 0;
  for (auto voxel = distance->cbeginValueOn(); voxel; ++voxel) {
    REQUIRE(*voxel <= 3 * kVoxel + 1e-6);
    const float s = sigma->getConstAccessor().getValue(voxel.getCoord());
    REQUIRE((s * s >= *least * 0.999f && s * s <= *most * 1.001f));
    if (looked_at++ % 20 != 0) continue;
    // OpenVDB hands the nearest face on from voxel to voxel: exact beside the surface, a little too far beyond.
    const double truth = distance_to(mesh, distance->indexToWorld(voxel.getCoord()));
    REQUIRE(*voxel > truth - 1e-5);
    REQUIRE(*voxel < truth + (truth < 0.8 * kVoxel ? 1e-5 : 0.5 * kVoxel));
    too_far += *voxel - truth;
  }
  CHECK(too_far / (looked_at / 20) < 0.02 * kVoxel);
}

TEST_CASE("a VDB file of an empty map holds empty grids") {
  std::istringstream in(to_vdb({}, 0.05));
  const auto grids = openvdb::io::Stream(in).getGrids();
  CHECK((*grids)[0]->activeVoxelCount() == 0);
}
