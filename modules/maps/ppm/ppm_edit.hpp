#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// The one way to change a map: takes a handle, stages changes, and commit() freezes the result as a new map that
/// shares every chunk part that was not written. Where the handle was the only one its memory is reused. Not
/// thread-safe; one session a map. Texel writes are in place (cloned on first write). Faces, vertices and moves are
/// staged and applied by commit(): until then chunk and face numbers stay those of map().
class PpmEdit {
 public:
  explicit PpmEdit(std::shared_ptr<const PpmMap> map);
  ~PpmEdit();

  /// The map as it was, with the texels written so far.
  const PpmMap& map() const { return *map_; }
  /// The chunk's texels for writing. The reference is good until commit(). Their counts must not change.
  Texels& texels(std::uint32_t chunk);

  /// A new vertex; returns its id.
  std::uint32_t add_vertex(const Eigen::Vector3f& position);
  /// Lets faces of this session use a vertex that the map has already.
  void use_vertex(std::uint32_t id, const Eigen::Vector3f& position);
  /// A new face over vertices of this session, counter-clockwise seen from free space; texels in the order of
  /// texel_index, texel_count(divisions) of them, with the map's colour channels. evidence, settled: to start with. The
  /// caller guarantees a sound edge (at most two faces, opposite winding); commit() checks it in debug builds.
  void add_face(const std::array<std::uint32_t, 3>& ids, std::uint8_t divisions, const TexelView& texels,
                FaceEvidence evidence = {}, bool settled = false);
  void remove_face(std::uint32_t chunk, std::uint32_t face);
  /// Moves a vertex, named by one of its copies, in every chunk that uses it. The last move of a vertex counts. Texel
  /// means are the caller's to re-express.
  void move_vertex(std::uint32_t chunk, std::uint32_t vertex, const Eigen::Vector3f& position);

  /// Applies what was staged and ends the session: removals, additions, moves; then normals of touched vertices, open
  /// edges, boxes, and new geometry ids for the chunks that changed. Kept faces and their texels keep their order, new
  /// ones follow in the order of add_face(). Costs in proportion to the chunks that change. In debug builds the result
  /// is checked.
  std::shared_ptr<const PpmMap> commit();

 private:
  struct Staged;
  class Commit;
  std::shared_ptr<PpmMap> map_;
  std::unique_ptr<Staged> staged_;
};

}  // namespace ppm
