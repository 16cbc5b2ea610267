#pragma once
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "framework/core/parallel.hpp"
#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/prediction/embree_scene.hpp"

namespace ppm {

/// The acceleration structures of all chunks of a set of maps, by Geometry::id: maps that share a chunk's shape share
/// its scene, whatever their texels. update() builds what is missing and drops what none of the given maps uses.
/// update() needs the object for itself; of() may be called from any thread in between.
class EmbreeScenes {
 public:
  explicit EmbreeScenes(EmbreeOptions options) : device_(options) {}

  /// Makes of() answer for exactly these maps, which must be alive whenever of() is called.
  void update(const std::vector<const PpmMap*>& maps, const Workers& workers);
  /// Scenes by chunk number; null for a chunk without faces. The map must have been given to the last update().
  const std::vector<const EmbreeScene*>& of(const PpmMap& map) const;

  std::size_t size() const { return entries_.size(); }  ///< scenes alive
  std::size_t built() const { return built_; }          ///< by the last update()
  std::int64_t bytes() const { return device_.bytes(); }

 private:
  struct Entry {
    std::unique_ptr<EmbreeScene> scene;
    std::uint64_t used = 0;  // number of the last update() that asked for it
  };
  EmbreeDevice device_;
  std::unordered_map<std::uint64_t, Entry> entries_;  // by Geometry::id
  std::unordered_map<const PpmMap*, std::vector<const EmbreeScene*>> by_map_;
  std::uint64_t updates_ = 0;
  std::size_t built_ = 0;
};

}  // namespace ppm
