#include "modules/maps/ppm/vertex_normals.hpp"

#include <algorithm>

namespace ppm {
namespace {

struct Use {
  VertexCopy copy;
  std::size_t item;  // in the list of vertices
};
struct Sum {
  Eigen::Vector3d all = Eigen::Vector3d::Zero();
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
};

/// Adds the faces of one chunk to the sums of the vertices in it. Doubles: the sum of a flat fan is exact to float.
void add_faces(const Geometry& geometry, std::span<const Use> uses, std::vector<Sum>& sums) {
  std::vector<std::uint32_t> item(geometry.position.size(), Geometry::kNoVertex);
  for (const auto& use : uses) item[use.copy.vertex] = static_cast<std::uint32_t>(use.item);
  for (const auto& face : geometry.face) {
    const auto& [a, b, c] = face;
    if ((item[a] & item[b] & item[c]) == Geometry::kNoVertex) continue;
    const Eigen::Vector3d p = geometry.position[a].cast<double>();
    const Eigen::Vector3d cross =
        (geometry.position[b].cast<double>() - p).cross(geometry.position[c].cast<double>() - p);
    for (auto v : face) {
      if (item[v] == Geometry::kNoVertex) continue;
      Sum& sum = sums[item[v]];
      if (sum.first.isZero(0)) sum.first = cross;
      sum.all += cross;
    }
  }
}

}  // namespace

std::vector<CopyNormal> vertex_normals(const PpmMap& map, std::span<const NewVertex> vertices) {
  std::vector<Use> uses;
  VertexFinder finder(map);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (const auto& copy : finder.copies(vertices[i].id, vertices[i].position)) uses.push_back({copy, i});
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.copy.chunk != b.copy.chunk ? a.copy.chunk < b.copy.chunk : a.copy.vertex < b.copy.vertex;
  });

  std::vector<Sum> sums(vertices.size());
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].copy.chunk == uses[begin].copy.chunk) ++end;
    add_faces(*map.table()[uses[begin].copy.chunk].geometry, std::span(uses).subspan(begin, end - begin), sums);
  }

  std::vector<CopyNormal> normals;
  normals.reserve(uses.size());
  for (const auto& use : uses) {
    const Sum& sum = sums[use.item];
    const bool cancels = sum.all.norm() <= 1e-9 * sum.first.norm();
    normals.push_back({use.copy, (cancels ? sum.first : sum.all).normalized().cast<float>()});
  }
  return normals;
}

}  // namespace ppm
