#include "modules/maps/vdb/vdb_mesh.hpp"

#include <Eigen/Geometry>
#include <unordered_map>

#include "modules/maps/vdb/vdb_reader.hpp"

namespace ppm {
namespace {

bool opposed(VdbCode a, VdbCode b) {
  return a != kVdbUnknown && b != kVdbUnknown && (a > 0) != (b > 0);
}

/// Calls found(voxel, axis, a, b) for each pair of neighbours voxel, voxel + axis that are known and of different sign,
/// with their codes. In the order of chunks, leaves, voxels, axes.
template <class Found>
void for_each_crossing(const VdbMap& map, const Found& found) {
  VdbReader reader(map);
  const auto visit = [&](const Cell& origin) {
    const auto here = reader.leaf(origin.x(), origin.y(), origin.z());
    for (int axis = 0; axis < 3; ++axis) {
      const Cell step = Cell::Unit(axis);
      const Cell next_origin = origin + kVdbLeafEdge * step;
      const auto next = reader.leaf(next_origin.x(), next_origin.y(), next_origin.z());
      const int first = here.codes ? 0 : kVdbLeafEdge - 1;  // inside a constant leaf nothing changes
      if (!here.codes && !next.codes && !opposed(here.constant, next.constant)) continue;
      for (int x = axis == 0 ? first : 0; x < kVdbLeafEdge; ++x)
        for (int y = axis == 1 ? first : 0; y < kVdbLeafEdge; ++y)
          for (int z = axis == 2 ? first : 0; z < kVdbLeafEdge; ++z) {
            const Cell at(x, y, z), to = at + step;
            const VdbCode a = here[vdb_voxel(x, y, z)];
            const VdbCode b = (to[axis] < kVdbLeafEdge ? here : next)[vdb_voxel(to.x(), to.y(), to.z())];
            if (opposed(a, b)) found(Cell(origin + at), axis, a, b);
          }
    }
  };
  for (std::size_t c = 0; c < map.table().size(); ++c) {
    const Cell origin = map.table().cell(c) * kVdbTileEdge;
    for (int x = 0; x < kVdbTileEdge; x += kVdbLeafEdge)
      for (int y = 0; y < kVdbTileEdge; y += kVdbLeafEdge)
        for (int z = 0; z < kVdbTileEdge; z += kVdbLeafEdge) visit(origin + Cell(x, y, z));
  }
}

/// A mesh whose vertices belong to points of a lattice.
class LatticeMesh {
 public:
  std::uint32_t vertex(const Cell& at) {
    const auto [it, added] = number_.try_emplace(at, static_cast<std::uint32_t>(mesh_.position.size()));
    if (added) {
      mesh_.position.push_back(Eigen::Vector3f::Zero());
      crossings_.push_back(0);
    }
    return it->second;
  }
  void set(std::uint32_t vertex, const Eigen::Vector3f& p) { mesh_.position[vertex] = p; }
  void add_crossing(std::uint32_t vertex, const Eigen::Vector3f& p) {
    mesh_.position[vertex] += p;
    ++crossings_[vertex];
  }
  void add_quad(const std::array<std::uint32_t, 4>& v, bool turned) {
    const auto face = [&](int a, int b, int c) {
      const auto at = [&](int k) { return v[static_cast<std::size_t>(k)]; };
      mesh_.face.push_back(turned ? std::array{at(a), at(c), at(b)} : std::array{at(a), at(b), at(c)});
    };
    face(0, 1, 2);
    face(0, 2, 3);
  }
  /// Vertices that had crossings become their mean.
  Mesh finish(double voxel_size_m) {
    for (std::size_t i = 0; i < crossings_.size(); ++i)
      if (crossings_[i] > 0) mesh_.position[i] /= static_cast<float>(crossings_[i]);
    mesh_.normal.assign(mesh_.position.size(), Eigen::Vector3f::Zero());
    for (const auto& f : mesh_.face) {
      const auto& p = mesh_.position;
      const Eigen::Vector3f normal = (p[f[1]] - p[f[0]]).cross(p[f[2]] - p[f[0]]);
      for (auto v : f) mesh_.normal[v] += normal;
    }
    for (auto& n : mesh_.normal) n = n.norm() > 0 ? n.normalized() : Eigen::Vector3f::UnitZ();
    mesh_.mean.assign(mesh_.position.size(), 0.f);
    mesh_.variance.assign(mesh_.position.size(), static_cast<float>(voxel_size_m * voxel_size_m / 12));
    return std::move(mesh_);
  }

 private:
  Mesh mesh_;
  std::vector<int> crossings_;
  std::unordered_map<Cell, std::uint32_t, CellHash> number_;
};

/// The corners of the unit square across an axis, counter-clockwise seen from its positive end.
std::array<Cell, 4> square(int axis) {
  const Cell u = Cell::Unit((axis + 1) % 3), v = Cell::Unit((axis + 2) % 3);
  return {Cell::Zero(), u, u + v, v};
}

}  // namespace

Mesh voxel_faces(const VdbMap& map) {
  LatticeMesh mesh;
  const double h = map.settings().voxel_size_m;
  for_each_crossing(map, [&](const Cell& voxel, int axis, VdbCode a, VdbCode) {
    std::array<std::uint32_t, 4> v;
    const auto corners = square(axis);
    for (std::size_t k = 0; k < 4; ++k) {
      const Cell corner = voxel + Cell::Unit(axis) + corners[k];
      v[k] = mesh.vertex(corner);
      mesh.set(v[k], (corner.cast<double>() * h).cast<float>());
    }
    mesh.add_quad(v, a <= 0);
  });
  return mesh.finish(h);
}

Mesh zero_surface(const VdbMap& map) {
  LatticeMesh mesh;
  const double h = map.settings().voxel_size_m;
  for_each_crossing(map, [&](const Cell& voxel, int axis, VdbCode a, VdbCode b) {
    Eigen::Vector3d p = voxel.cast<double>().array() + 0.5;
    p[axis] += static_cast<double>(a) / (a - b);
    std::array<std::uint32_t, 4> v;
    const auto corners = square(axis);
    for (std::size_t k = 0; k < 4; ++k) {  // the four cubes around the edge; a cube is named by its lowest centre
      v[k] = mesh.vertex(voxel - corners[2] + corners[k]);
      mesh.add_crossing(v[k], (p * h).cast<float>());
    }
    mesh.add_quad(v, a <= 0);
  });
  return mesh.finish(h);
}

}  // namespace ppm
