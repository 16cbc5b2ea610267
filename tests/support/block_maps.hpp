#pragma once
#include <map>
#include <memory>
#include <vector>

#include "framework/slam/map.hpp"
#include "framework/slam/map_codec.hpp"

namespace ppm::test {

/// A map of blocks that copies share, each of a number: the simplest map with structure to share.
class BlockMap final : public Map {
 public:
  std::vector<std::shared_ptr<const int>> blocks;

  std::string_view kind() const override { return "block"; }
  MapStats stats() const override {
    MapStats stats;
    stats.chunks = static_cast<std::int64_t>(blocks.size());
    stats.bytes = 100 * stats.chunks;
    return stats;
  }
  std::int64_t account(std::unordered_set<const void*>& seen) const override {
    std::int64_t bytes = 0;
    for (const auto& block : blocks) bytes += seen.insert(block.get()).second ? 100 : 0;
    return bytes;
  }
  void digest(Digest& digest) const override {
    for (const auto& block : blocks) digest.add(*block);
  }
  Mesh mesh(Surface) const override { return {}; }
};

inline MapHandle block_map(int first) {
  auto map = std::make_shared<BlockMap>();
  map->blocks.push_back(std::make_shared<const int>(first));
  return map;
}

/// A map that shares all blocks of another and has one more.
inline MapHandle grown(const MapHandle& map, int number) {
  auto next = std::make_shared<BlockMap>(static_cast<const BlockMap&>(*map));
  next->blocks.push_back(std::make_shared<const int>(number));
  return next;
}

class BlockCodec final : public MapCodec {
 public:
  void save(const std::vector<const Map*>& maps, RecordFileWriter& file) const override {
    std::map<const int*, std::uint32_t> number;
    std::vector<int> blocks;
    std::vector<std::vector<std::uint32_t>> tables;
    for (const auto* map : maps) {
      auto& table = tables.emplace_back();
      for (const auto& block : static_cast<const BlockMap&>(*map).blocks) {
        const auto [it, added] = number.emplace(block.get(), static_cast<std::uint32_t>(blocks.size()));
        if (added) blocks.push_back(*block);
        table.push_back(it->second);
      }
    }
    RecordWriter out;
    out.add(blocks);
    out.add(tables);
    file.write(out);
  }
  std::vector<MapHandle> load(RecordFileReader& file) const override {
    auto in = file.next("the blocks");
    std::vector<std::shared_ptr<const int>> blocks;
    for (int value : in.take<std::vector<int>>()) blocks.push_back(std::make_shared<const int>(value));
    std::vector<MapHandle> maps;
    for (const auto& table : in.take<std::vector<std::vector<std::uint32_t>>>()) {
      auto map = std::make_shared<BlockMap>();
      for (auto number : table) map->blocks.push_back(blocks.at(number));
      maps.push_back(map);
    }
    in.finish();
    return maps;
  }
};

}  // namespace ppm::test
