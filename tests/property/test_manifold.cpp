#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <catch2/catch.hpp>
#include <set>

#include "tests/property/map_experiment.hpp"

using namespace ppm;
using OracleMesh = OpenMesh::TriMesh_ArrayKernelT<>;

namespace {

/// The mesh as OpenMesh sees it: add_face() refuses what is not manifold.
OracleMesh oracle_mesh(const Mesh& mesh) {
  OracleMesh oracle;
  for (const auto& p : mesh.position) oracle.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& f : mesh.face) {
    auto vertex = [&](std::size_t k) { return oracle.vertex_handle(f[k]); };
    REQUIRE(oracle.add_face(vertex(0), vertex(1), vertex(2)).is_valid());
  }
  return oracle;
}

/// Open edges of the whole map: those that are open in their chunk and have no partner in another.
std::size_t open_edges_over_chunks(const PpmMap& map) {
  std::set<std::array<std::uint32_t, 2>> open;
  for (const auto& chunk : map.table().chunks())
    open.insert(chunk.geometry->open_edge.begin(), chunk.geometry->open_edge.end());
  std::size_t count = 0;
  for (const auto& [a, b] : open) count += open.count({b, a}) == 0;
  return count;
}

}  // namespace

TEST_CASE("OpenMesh takes every map for a manifold, with the same border") {
  for (std::uint64_t seed = 40; seed < 48; ++seed) {
    test::MapExperiment experiment(seed, false);
    for (int step = 0; step < 60; ++step) {
      experiment.step();
      for (std::size_t i = 0; i < experiment.belief().size(); ++i) {
        const auto& map = experiment.map(i);
        const OracleMesh oracle = oracle_mesh(map.mesh(Surface::base));
        CHECK(static_cast<std::int64_t>(oracle.n_vertices()) == map.stats().vertices);
        CHECK(static_cast<std::int64_t>(oracle.n_faces()) == map.stats().faces);
        std::size_t border = 0;
        for (const auto h : oracle.halfedges()) border += oracle.is_boundary(h);
        CHECK(border == open_edges_over_chunks(map));
      }
    }
  }
}
