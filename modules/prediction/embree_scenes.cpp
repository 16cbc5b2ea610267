#include "modules/prediction/embree_scenes.hpp"

#include "framework/core/error.hpp"

namespace ppm {

void EmbreeScenes::update(const std::vector<const PpmMap*>& maps, const Workers& workers) {
  ++updates_;
  std::vector<std::pair<Entry*, const Geometry*>> missing;
  for (const PpmMap* map : maps)
    for (const PpmChunk& chunk : map->table().chunks()) {
      if (chunk.geometry->face.empty()) continue;
      Entry& entry = entries_[chunk.geometry->id];
      if (!entry.scene && entry.used != updates_) missing.emplace_back(&entry, chunk.geometry.get());
      entry.used = updates_;
    }
  workers.for_each(missing.size(), [&](std::size_t i, int) {
    missing[i].first->scene = std::make_unique<EmbreeScene>(device_, *missing[i].second);
  });
  built_ = missing.size();
  std::erase_if(entries_, [&](const auto& item) { return item.second.used != updates_; });

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
