#pragma once
#include <memory>
#include <vector>

#include "framework/core/rng.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"
#include "tests/property/naive_mesh.hpp"

namespace ppm::test {

/// A belief whose maps are changed at random, and beside each map what it should hold, copied deeply.
class MapExperiment {
 public:
  MapExperiment(std::uint64_t seed, bool keep_old_handles) : rng_(seed, 0, 0, 0), keep_old_handles_(keep_old_handles) {
    PpmSettings settings;
    settings.cell_size_m = 0.3;
    auto empty = std::make_shared<const PpmMap>(settings);
    belief_.init(4, Pose::Identity(), empty);
    expected_.resize(4);
  }

  void step() {
    if (rng_.below(8) == 0)
      gather();
    else
      edit(rng_.below(static_cast<std::uint32_t>(belief_.size())));
  }

  const ParticleSet& belief() const { return belief_; }
  const PpmMap& map(std::size_t i) const { return dynamic_cast<const PpmMap&>(*belief_.map[i]); }
  const NaiveMesh& expected(std::size_t i) const { return expected_[i]; }

 private:
  float random(double least, double most) { return static_cast<float>(least + (most - least) * rng_.uniform()); }
  Eigen::Vector3f place(const NaiveMesh& mesh, std::uint32_t id) const {
    return Eigen::Vector3f(mesh.at.at(id).data());
  }

  void gather() {
    std::vector<std::uint32_t> ancestors;
    std::vector<NaiveMesh> next;
    for (std::size_t i = 0; i < 2 + rng_.below(5); ++i) {
      ancestors.push_back(rng_.below(static_cast<std::uint32_t>(belief_.size())));
      next.push_back(expected_[ancestors.back()]);
    }
    belief_.gather(ancestors);
    expected_ = std::move(next);
  }

  void edit(std::size_t particle) {
    auto& mesh = expected_[particle];
    if (keep_old_handles_) old_.push_back(belief_.map[particle]);
    auto handle = std::static_pointer_cast<const PpmMap>(std::move(belief_.map[particle]));
    PpmEdit session(std::move(handle));
    write_texels(session, mesh);
    move_vertices(session, mesh);  // faces that are removed too may be moved first
    remove_faces(session, mesh);
    add_faces(session, mesh);
    auto map = session.commit();
    map->check();
    belief_.map[particle] = std::move(map);
  }

  void write_texels(PpmEdit& session, NaiveMesh& mesh) {
    for (std::uint32_t n = 0; n < 3 && !mesh.faces.empty(); ++n) {
      const auto chunk = rng_.below(static_cast<std::uint32_t>(session.map().table().size()));
      const Geometry& g = *session.map().table()[chunk].geometry;
      if (g.face.empty()) continue;
      const auto f = rng_.below(static_cast<std::uint32_t>(g.face.size()));
      const auto t = rng_.below(texel_count(g.divisions[f]));
      auto& face = mesh.faces.at(ids(g, f));
      Texels& texels = session.texels(chunk);
      texels.mean[g.first_texel[f] + t] = face.mean[t] = random(-0.1, 0.1);
      texels.variance[g.first_texel[f] + t] = face.variance[t] = random(0.001, 0.1);
      texels.evidence[f].hits = static_cast<std::uint16_t>(++face.hits);
    }
  }

  void move_vertices(PpmEdit& session, NaiveMesh& mesh) {
    for (std::uint32_t n = rng_.below(3); n > 0 && !mesh.faces.empty(); --n) {
      const auto chunk = rng_.below(static_cast<std::uint32_t>(session.map().table().size()));
      const Geometry& g = *session.map().table()[chunk].geometry;
      if (g.position.empty()) continue;
      const auto v = rng_.below(static_cast<std::uint32_t>(g.position.size()));
      const Eigen::Vector3f to =
          g.position[v] + Eigen::Vector3f(random(-0.02, 0.02), random(-0.02, 0.02), random(-0.02, 0.02));
      session.move_vertex(chunk, v, to);
      mesh.at[g.vertex_id[v]] = {to.x(), to.y(), to.z()};
    }
  }

  void remove_faces(PpmEdit& session, NaiveMesh& mesh) {
    std::uint32_t wanted = rng_.below(4);
    const auto& table = session.map().table();
    for (std::uint32_t chunk = 0; chunk < table.size() && wanted > 0; ++chunk)
      for (std::uint32_t f = 0; f < table[chunk].geometry->face.size() && wanted > 0; ++f) {
        if (rng_.below(20) != 0) continue;
        session.remove_face(chunk, f);
        mesh.remove(ids(*table[chunk].geometry, f));
        --wanted;
      }
  }

  /// New faces on open edges, towards a new vertex, and now and then one that touches nothing.
  void add_faces(PpmEdit& session, NaiveMesh& mesh) {
    auto open = mesh.open_edges();
    for (std::uint32_t n = rng_.below(8); n > 0; --n) {
      NaiveMesh::Ids corner;
      if (open.empty() || rng_.below(6) == 0) {
        const Eigen::Vector3f p(random(-1, 1), random(-1, 1), random(-1, 1));
        for (std::size_t k = 0; k < 3; ++k)
          corner[k] = new_vertex(session, mesh, p + 0.15f * Eigen::Vector3f::Unit(static_cast<int>(k)));
      } else {
        const auto choice = rng_.below(static_cast<std::uint32_t>(open.size()));
        const auto [b, a] = open[choice];
        open.erase(open.begin() + choice);
        const Eigen::Vector3f pa = old_place(session, mesh, a), pb = old_place(session, mesh, b);
        const Eigen::Vector3f apex =
            0.5f * (pa + pb) + Eigen::Vector3f(random(-0.2, 0.2), random(-0.2, 0.2), random(-0.2, 0.2));
        corner = {a, b, new_vertex(session, mesh, apex)};
      }
      NaiveMesh::Face face;
      face.divisions = static_cast<std::uint8_t>(1 + rng_.below(5));
      face.hits = static_cast<int>(rng_.below(50));
      for (std::uint32_t t = 0; t < texel_count(face.divisions); ++t) {
        face.mean.push_back(random(-0.1, 0.1));
        face.variance.push_back(random(0.001, 0.1));
      }
      session.add_face(corner, face.divisions, {face.mean, face.variance}, {static_cast<std::uint16_t>(face.hits), 0});
      mesh.faces[corner] = face;
    }
  }

  std::uint32_t new_vertex(PpmEdit& session, NaiveMesh& mesh, const Eigen::Vector3f& p) {
    const auto id = session.add_vertex(p);
    mesh.at[id] = {p.x(), p.y(), p.z()};
    return id;
  }
  /// Brings a vertex that the map has into the session, at the place that the map has it in.
  Eigen::Vector3f old_place(PpmEdit& session, const NaiveMesh& mesh, std::uint32_t id) {
    for (const auto& chunk : session.map().table().chunks()) {
      const auto v = chunk.geometry->find_vertex(id);
      if (v == Geometry::kNoVertex) continue;
      session.use_vertex(id, chunk.geometry->position[v]);
      return chunk.geometry->position[v];
    }
    return place(mesh, id);  // new in this session
  }
  static NaiveMesh::Ids ids(const Geometry& g, std::size_t f) {
    const auto& c = g.face[f];
    return {g.vertex_id[c[0]], g.vertex_id[c[1]], g.vertex_id[c[2]]};
  }

  Rng rng_;
  bool keep_old_handles_;
  ParticleSet belief_;
  std::vector<NaiveMesh> expected_;
  std::vector<MapHandle> old_;
};

}  // namespace ppm::test
