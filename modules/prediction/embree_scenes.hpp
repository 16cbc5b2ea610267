#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "framework/core/parallel.hpp"
#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/prediction/embree_scene.hpp"

namespace ppm {

/// The scenes of one kind that are alive in this process, by Geometry::id: nodes that look at the same maps share them.
/// Owns none. Thread-safe.
class EmbreeStore {
 public:
  explicit EmbreeStore(const EmbreeOptions& options) : device_(options) {}
  /// The one store for these options, made where nobody has it.
  static std::shared_ptr<EmbreeStore> of(const EmbreeOptions& options);

  const EmbreeDevice& device() const { return device_; }
  /// The scene of that geometry, or null.
  std::shared_ptr<const EmbreeScene> find(std::uint64_t geometry_id);
  void add(std::uint64_t geometry_id, const std::shared_ptr<const EmbreeScene>& scene);
  /// Forgets the scenes that nobody owns any more.
  void tidy();

 private:
  EmbreeDevice device_;
  std::mutex mutex_;
  std::unordered_map<std::uint64_t, std::weak_ptr<const EmbreeScene>> scenes_;
};

/// The acceleration structures of all chunks of a set of maps, by Geometry::id: maps that share a chunk's shape share
/// its scene, whatever their texels, and so do all objects of this class with equal options. update() builds what is
/// missing and drops what none of the given maps uses. update() needs the object for itself; of() may be called from any
/// thread in between.
class EmbreeScenes {
 public:
  explicit EmbreeScenes(const EmbreeOptions& options) : store_(EmbreeStore::of(options)) {}

  /// Makes of() answer for exactly these maps, which must be alive whenever of() is called.
  void update(const std::vector<const PpmMap*>& maps, const Workers& workers);
  /// Scenes by chunk number; null for a chunk without faces. The map must have been given to the last update().
  const std::vector<const EmbreeScene*>& of(const PpmMap& map) const;

  std::size_t size() const { return entries_.size(); }  ///< scenes in use here
  std::size_t built() const { return built_; }          ///< by the last update()
  /// Of all scenes with these options, whoever uses them.
  std::int64_t bytes() const { return store_->device().bytes(); }

 private:
  struct Entry {
    std::shared_ptr<const EmbreeScene> scene;
    std::uint64_t used = 0;  // number of the last update() that asked for it
  };
  std::shared_ptr<EmbreeStore> store_;
  std::unordered_map<std::uint64_t, Entry> entries_;  // by Geometry::id
  std::unordered_map<const PpmMap*, std::vector<const EmbreeScene*>> by_map_;
  std::uint64_t updates_ = 0;
  std::size_t built_ = 0;
};

}  // namespace ppm
