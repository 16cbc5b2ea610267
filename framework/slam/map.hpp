#pragma once
#include <cstdint>
#include <memory>
#include <string_view>
#include <unordered_set>

#include "framework/core/digest.hpp"
#include "framework/slam/mesh.hpp"

namespace ppm {

/// Sizes of one map. Elements that a kind of map does not have are 0.
struct MapStats {
  std::int64_t chunks = 0, vertices = 0, faces = 0, texels = 0;
  std::int64_t bytes = 0;  ///< all memory that this map refers to, as if it were alone
};

/// Which surface to extract: the elements as they are, or the surface that the map describes (a mesh's texels, each
/// moved by its mean).
enum class Surface { base, displaced };

/// A map as seen by code that does not know its kind. Immutable behind its handle: an edit makes a new one that shares
/// what did not change (see ChunkTable).
class Map {
 public:
  virtual ~Map() = default;
  /// The kind, as in the belief's facet "map.<kind>": "ppm", "vdb".
  virtual std::string_view kind() const = 0;
  virtual MapStats stats() const = 0;
  /// Channels of colour beside the geometry: 0 (none), 1 (intensity) or 3 (red, green, blue).
  virtual int color_channels() const { return 0; }
  /// Adds every block of memory (address, size) of this map that is not in `seen` yet; returns the bytes added.
  /// Over the particles of a belief the sum is what the maps occupy together.
  virtual std::int64_t account(std::unordered_set<const void*>& seen) const = 0;
  virtual void digest(Digest& digest) const = 0;
  virtual Mesh mesh(Surface surface) const = 0;
};

using MapHandle = std::shared_ptr<const Map>;

}  // namespace ppm
