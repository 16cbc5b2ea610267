#include <octomap/OcTree.h>

#include <unordered_map>

#include "modules/maps/octomap/octomap_map.hpp"
#include "modules/maps/octomap/octomap_ray.hpp"

namespace ppm {

namespace {

using Cells = std::array<int, 3>;  // numbers of cells, or of their corners, by axis

/// The squares between occupied cells and free ones, as two triangles each; corners that squares share are one vertex.
class BoundaryMesh {
 public:
  explicit BoundaryMesh(const octomap::OcTree& tree) : tree_(tree), lookup_(tree) {}

  /// The leaf's boundary. first: its first cell; cells: its edge.
  void add_leaf(const Cells& first, int cells) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true})
        for (int u = 0; u < cells; ++u)
          for (int v = 0; v < cells; ++v) {
            Cells cell = first;
            cell[axis] += upper ? cells - 1 : 0;
            cell[(axis + 1) % 3] += u;
            cell[(axis + 2) % 3] += v;
            if (faces_free(cell, axis, upper)) add_square(cell, axis, upper);
          }
  }

  Mesh finish() {
    for (auto& normal : mesh_.normal) normal = normal.isZero() ? Eigen::Vector3f::UnitZ() : normal.normalized();
    const auto size = static_cast<float>(tree_.getResolution());
    mesh_.mean.assign(mesh_.position.size(), 0.0f);
    mesh_.variance.assign(mesh_.position.size(), size * size / 12);
    return std::move(mesh_);
  }

 private:
  bool faces_free(Cells cell, std::size_t axis, bool upper) {
    cell[axis] += upper ? 1 : -1;
    if (cell[axis] < 0 || cell[axis] > 0xffff) return false;
    const auto* node = lookup_.leaf({static_cast<std::uint16_t>(cell[0]), static_cast<std::uint16_t>(cell[1]),
                                     static_cast<std::uint16_t>(cell[2])});
    return node && !tree_.isNodeOccupied(node);
  }

  void add_square(const Cells& cell, std::size_t axis, bool upper) {
    Eigen::Vector3f outward = Eigen::Vector3f::Zero();
    outward[static_cast<Eigen::Index>(axis)] = upper ? 1.0f : -1.0f;
    std::array<std::uint32_t, 4> corner{};
    constexpr int kAround[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (std::size_t k = 0; k < 4; ++k) {
      Cells at = cell;
      at[axis] += upper ? 1 : 0;
      at[(axis + 1) % 3] += kAround[k][0];
      at[(axis + 2) % 3] += kAround[k][1];
      corner[k] = vertex(at);
      mesh_.normal[corner[k]] += outward;
    }
    if (!upper) std::swap(corner[1], corner[3]);
    mesh_.face.push_back({corner[0], corner[1], corner[2]});
    mesh_.face.push_back({corner[0], corner[2], corner[3]});
  }

  std::uint32_t vertex(const Cells& at) {
    const auto key = static_cast<std::uint64_t>(at[0]) << 40 | static_cast<std::uint64_t>(at[1]) << 20 |
                     static_cast<std::uint64_t>(at[2]);
    const auto [it, added] = number_.try_emplace(key, static_cast<std::uint32_t>(mesh_.position.size()));
    if (added) {
      const Eigen::Vector3d cells(at[0] - 0x8000, at[1] - 0x8000, at[2] - 0x8000);
      mesh_.position.push_back((cells * tree_.getResolution()).cast<float>());
      mesh_.normal.push_back(Eigen::Vector3f::Zero());
    }
    return it->second;
  }

  const octomap::OcTree& tree_;
  OctomapLookup lookup_;
  Mesh mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> number_;  // of a vertex by corner
};

}  // namespace

Mesh OctomapMap::mesh(Surface) const {
  BoundaryMesh boundary(*tree_);
  for (auto leaf = tree_->begin_leafs(); leaf != tree_->end_leafs(); ++leaf) {
    if (!tree_->isNodeOccupied(*leaf)) continue;
    const int cells = 1 << (tree_->getTreeDepth() - leaf.getDepth());
    const auto first = leaf.getIndexKey();
    boundary.add_leaf({first[0], first[1], first[2]}, cells);
  }
  return boundary.finish();
}

}  // namespace ppm
