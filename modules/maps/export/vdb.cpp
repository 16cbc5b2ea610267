#include "modules/maps/export/vdb.hpp"

#include <openvdb/io/Stream.h>
#include <openvdb/math/Proximity.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tree/LeafManager.h>

#include <cmath>
#include <sstream>

namespace ppm {
namespace {

/// The mesh as OpenVDB's converter wants it: in units of voxels.
class IndexSpaceMesh {
 public:
  IndexSpaceMesh(const Mesh& mesh, double voxel_m) : mesh_(mesh), voxel_m_(voxel_m) {}
  std::size_t polygonCount() const { return mesh_.face.size(); }
  std::size_t pointCount() const { return mesh_.position.size(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t face, std::size_t corner, openvdb::Vec3d& p) const {
    const auto& q = mesh_.position[mesh_.face[face][corner]];
    p = openvdb::Vec3d(q.x(), q.y(), q.z()) / voxel_m_;
  }
  /// The standard deviation at the face's point nearest to a voxel.
  float sigma(std::size_t face, const openvdb::Coord& voxel) const {
    openvdb::Vec3d a, b, c, weight;
    getIndexSpacePoint(face, 0, a);
    getIndexSpacePoint(face, 1, b);
    getIndexSpacePoint(face, 2, c);
    openvdb::math::closestPointOnTriangleToPoint(a, b, c, voxel.asVec3d(), weight);
    double variance = 0;
    for (int k = 0; k < 3; ++k) variance += weight[k] * mesh_.variance[mesh_.face[face][static_cast<std::size_t>(k)]];
    return static_cast<float>(std::sqrt(variance));
  }

 private:
  const Mesh& mesh_;
  double voxel_m_;
};

openvdb::FloatGrid::Ptr sigma_grid(const openvdb::FloatGrid& distance, const openvdb::Int32Grid& nearest,
                                   const IndexSpaceMesh& mesh) {
  auto sigma = openvdb::FloatGrid::create(0.0f);
  sigma->setTransform(distance.transform().copy());
  sigma->topologyUnion(distance);
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(sigma->tree());
  leaves.foreach([&](auto& leaf, std::size_t) {
    const auto* faces = nearest.tree().probeConstLeaf(leaf.origin());
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel)
      voxel.setValue(mesh.sigma(static_cast<std::size_t>(faces->getValue(voxel.pos())), voxel.getCoord()));
  });
  return sigma;
}

}  // namespace

std::string to_vdb(const Mesh& mesh, double voxel_m, float band) {
  openvdb::initialize();
  const IndexSpaceMesh points(mesh, voxel_m);
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel_m);
  openvdb::Int32Grid nearest(-1);
  const auto distance = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      points, *transform, band, band, openvdb::tools::UNSIGNED_DISTANCE_FIELD, &nearest);
  const auto sigma = sigma_grid(*distance, nearest, points);
  distance->setName("distance");
  sigma->setName("sigma");
  for (const auto& grid : {distance, sigma}) {
    grid->setCreator("ppm");
    grid->insertMeta("unit", openvdb::StringMetadata("m"));
  }
  std::ostringstream bytes;
  openvdb::io::Stream(bytes).write(openvdb::GridPtrVec{distance, sigma});
  return std::move(bytes).str();
}

}  // namespace ppm
