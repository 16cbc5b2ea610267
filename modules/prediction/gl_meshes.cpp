#include "modules/prediction/gl_meshes.hpp"

#include "framework/core/error.hpp"
#include "modules/prediction/gl_triangles.hpp"

namespace ppm {

GlMeshes::GlMeshes(const GlFunctions& gl) : position_(gl, 3 * sizeof(float)), index_(gl, 3 * sizeof(std::uint32_t)) {}

void GlMeshes::update(const std::vector<const PpmMap*>& maps) {
  ++updates_;
  std::vector<const Geometry*> missing;
  for (const PpmMap* map : maps)
    for (const PpmChunk& chunk : map->table().chunks()) {
      if (chunk.geometry->face.empty()) continue;
      Entry& entry = entries_[chunk.geometry->id];
      if (entry.used == 0) missing.push_back(chunk.geometry.get());
      entry.used = updates_;
    }
  drop_unused();  // makes room first
  for (const Geometry* geometry : missing) {
    GlMesh& mesh = entries_.at(geometry->id).mesh;
    const GlTriangles triangles(*geometry);
    mesh.vertices = static_cast<std::uint32_t>(triangles.position.size());
    mesh.faces = static_cast<std::uint32_t>(triangles.face.size());
    mesh.first_vertex = static_cast<std::uint32_t>(position_.add(triangles.position.data(), mesh.vertices));
    mesh.first_face = static_cast<std::uint32_t>(index_.add(triangles.face.data(), mesh.faces));
  }
  added_ = missing.size();
}

void GlMeshes::drop_unused() {
  std::erase_if(entries_, [&](const auto& item) {
    const auto& [mesh, used] = item.second;
    if (used == updates_) return false;
    position_.remove(mesh.first_vertex, mesh.vertices);
    index_.remove(mesh.first_face, mesh.faces);
    return true;
  });
}

const GlMesh& GlMeshes::of(const Geometry& geometry) const {
  auto found = entries_.find(geometry.id);
  PPM_CHECK(found != entries_.end(), "a map is drawn that was not prepared");
  return found->second.mesh;
}

}  // namespace ppm
