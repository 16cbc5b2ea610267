#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/prediction/gl_heap.hpp"

namespace ppm {

/// Where a chunk's triangles lie on the device, see GlTriangles.
struct GlMesh {
  std::uint32_t first_vertex = 0, vertices = 0;
  std::uint32_t first_face = 0, faces = 0;
};

/// The triangles of all chunks of a set of maps on the device, by Geometry::id: maps that share a chunk's shape share
/// its triangles. Every call but of(), the destructor too, needs the context to be current.
class GlMeshes {
 public:
  explicit GlMeshes(const GlFunctions& gl);

  /// Copies what is missing to the device and drops what none of the given maps uses.
  void update(const std::vector<const PpmMap*>& maps);
  /// Of a chunk with faces, of a map that was given to the last update().
  const GlMesh& of(const Geometry& geometry) const;

  unsigned positions() const { return position_.buffer(); }  ///< 3 floats a vertex, m, map frame
  unsigned indices() const { return index_.buffer(); }  ///< 3 unsigned integers a face, from the mesh's first vertex
  std::size_t size() const { return entries_.size(); }
  std::size_t added() const { return added_; }  ///< by the last update()
  std::int64_t bytes() const { return position_.bytes() + index_.bytes(); }

 private:
  struct Entry {
    GlMesh mesh;
    std::uint64_t used = 0;  // number of the last update() that asked for it
  };
  void drop_unused();

  GlHeap position_, index_;
  std::unordered_map<std::uint64_t, Entry> entries_;  // by Geometry::id
  std::uint64_t updates_ = 0;
  std::size_t added_ = 0;
};

}  // namespace ppm
