#include "modules/prediction/embree_scenes.hpp"

#include <map>

#include "framework/core/error.hpp"

namespace ppm {

std::shared_ptr<EmbreeStore> EmbreeStore::of(const EmbreeOptions& options) {
  static std::mutex mutex;
  static std::map<EmbreeOptions, std::weak_ptr<EmbreeStore>> stores;
  std::lock_guard lock(mutex);
  auto& known = stores[options];
  auto store = known.lock();
  if (!store) known = store = std::make_shared<EmbreeStore>(options);
  return store;
}

std::shared_ptr<const EmbreeScene> EmbreeStore::find(std::uint64_t geometry_id) {
  std::lock_guard lock(mutex_);
  const auto found = scenes_.find(geometry_id);
  return found == scenes_.end() ? nullptr : found->second.lock();
}

void EmbreeStore::add(std::uint64_t geometry_id, const std::shared_ptr<const EmbreeScene>& scene) {
  std::lock_guard lock(mutex_);
  scenes_[geometry_id] = scene;
}

void EmbreeStore::tidy() {
  std::lock_guard lock(mutex_);
  std::erase_if(scenes_, [](const auto& item) { return item.second.expired(); });
}

void EmbreeScenes::update(const std::vector<const PpmMap*>& maps, const Workers& workers) {
  ++updates_;
  std::vector<std::pair<Entry*, const Geometry*>> missing;
  for (const PpmMap* map : maps)
    for (const PpmChunk& chunk : map->table().chunks()) {
      if (chunk.geometry->face.empty()) continue;
      Entry& entry = entries_[chunk.geometry->id];
      if (!entry.scene && entry.used != updates_) {
        entry.scene = store_->find(chunk.geometry->id);
        if (!entry.scene) missing.emplace_back(&entry, chunk.geometry.get());
      }
      entry.used = updates_;
    }
  workers.for_each(missing.size(), [&](std::size_t i, int) {
    auto& [entry, geometry] = missing[i];
    entry->scene = std::make_shared<const EmbreeScene>(store_->device(), *geometry);
    store_->add(geometry->id, entry->scene);
  });
  built_ = missing.size();
  if (std::erase_if(entries_, [&](const auto& item) { return item.second.used != updates_; }) > 0) store_->tidy();

  by_map_.clear();
  for (const PpmMap* map : maps) {
    auto& scenes = by_map_[map];
    if (!scenes.empty()) continue;
    scenes.reserve(map->table().size());
    for (const PpmChunk& chunk : map->table().chunks())
      scenes.push_back(chunk.geometry->face.empty() ? nullptr : entries_.at(chunk.geometry->id).scene.get());
  }
}

const std::vector<const EmbreeScene*>& EmbreeScenes::of(const PpmMap& map) const {
  auto found = by_map_.find(&map);
  PPM_CHECK(found != by_map_.end(), "a map is looked at that was not prepared");
  return found->second;
}

}  // namespace ppm
