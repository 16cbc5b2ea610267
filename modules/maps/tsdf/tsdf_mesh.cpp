#include <open3d/geometry/TriangleMesh.h>
#include <open3d/pipelines/integration/ScalableTSDFVolume.h>

#include <algorithm>
#include <numeric>

#include "modules/maps/tsdf/tsdf_map.hpp"

namespace ppm {

namespace {

using Face = std::array<std::uint32_t, 3>;

/// Numbers of a mesh's vertices by place, so that the order in which a hash table gave them does not matter.
std::vector<std::uint32_t> order_of(const std::vector<Eigen::Vector3d>& vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](auto a, auto b) {
    return std::lexicographical_compare(vertices[a].data(), vertices[a].data() + 3, vertices[b].data(),
                                        vertices[b].data() + 3);
  });
  return order;
}

/// Of the faces around, weighted by their areas.
void add_normals(Mesh& mesh) {
  mesh.normal.assign(mesh.position.size(), Eigen::Vector3f::Zero());
  for (const auto& f : mesh.face) {
    const Eigen::Vector3f across =
        (mesh.position[f[1]] - mesh.position[f[0]]).cross(mesh.position[f[2]] - mesh.position[f[0]]);
    for (const auto vertex : f) mesh.normal[vertex] += across;
  }
  for (auto& normal : mesh.normal) normal = normal.norm() > 0 ? normal.normalized() : Eigen::Vector3f::UnitZ();
}

}  // namespace

Mesh TsdfMap::mesh(Surface) const {
  const auto extracted = volume_->ExtractTriangleMesh();
  const auto order = order_of(extracted->vertices_);
  std::vector<std::uint32_t> number(order.size());
  Mesh mesh;
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[order[i]] = static_cast<std::uint32_t>(i);
    mesh.position.push_back(extracted->vertices_[order[i]].cast<float>());
  }
  for (const auto& t : extracted->triangles_) {
    Face face;
    for (std::size_t k = 0; k < 3; ++k) face[k] = number[static_cast<std::size_t>(t[static_cast<Eigen::Index>(k)])];
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    mesh.face.push_back(face);
  }
  std::ranges::sort(mesh.face);
  add_normals(mesh);
  const auto size = static_cast<float>(settings_.voxel_size_m);
  mesh.mean.assign(mesh.position.size(), 0.0f);
  mesh.variance.assign(mesh.position.size(), size * size / 12);
  return mesh;
}

}  // namespace ppm
