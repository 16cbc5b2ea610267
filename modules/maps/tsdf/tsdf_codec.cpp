#include "modules/maps/tsdf/tsdf_codec.hpp"

#include <fmt/format.h>

#include <unordered_map>

#include "modules/maps/tsdf/tsdf_map.hpp"

// Records: the numbers of blocks and maps; each block, its place and voxels; each map, its settings and numbers of blocks.

namespace ppm {

namespace {

constexpr std::size_t kVoxels = TsdfMap::kBlock * TsdfMap::kBlock * TsdfMap::kBlock;

void save_block(const TsdfBlocks::Entry& entry, RecordFileWriter& file) {
  std::vector<float> tsdf, weight;
  TsdfMap::read_block(*entry.second, tsdf, weight);
  RecordWriter out;
  out.add(entry.first);
  out.add(tsdf);
  out.add(weight);
  file.write(out);
}

struct SavedBlock {
  Eigen::Vector3i place;
  std::vector<float> tsdf, weight;
};

SavedBlock load_block(RecordReader in) {
  SavedBlock block;
  in.take(block.place);
  in.take(block.tsdf);
  in.take(block.weight);
  in.finish();
  if (block.tsdf.size() != kVoxels || block.weight.size() != kVoxels) in.fail("has not the voxels of a block");
  return block;
}

}  // namespace

void TsdfCodec::save(const std::vector<const Map*>& maps, RecordFileWriter& file) const {
  std::unordered_map<const TsdfBlock*, std::uint32_t> number;
  std::vector<TsdfBlocks::Entry> blocks;
  std::vector<RecordWriter> tables;
  for (const Map* map : maps) {
    const auto& volume = static_cast<const TsdfMap&>(*map);
    std::vector<std::uint32_t> numbers;
    for (const auto& entry : volume.sorted_blocks()) {
      const auto [it, added] = number.emplace(entry.second, static_cast<std::uint32_t>(blocks.size()));
      if (added) blocks.push_back(entry);
      numbers.push_back(it->second);
    }
    auto& out = tables.emplace_back();
    out.add(volume.settings());
    out.add(numbers);
  }
  RecordWriter counts;
  counts.add(static_cast<std::uint64_t>(blocks.size()));
  counts.add(static_cast<std::uint64_t>(tables.size()));
  file.write(counts);
  for (const auto& block : blocks) save_block(block, file);
  for (const auto& table : tables) file.write(table);
}

std::vector<MapHandle> TsdfCodec::load(RecordFileReader& file) const {
  auto counts = file.next("the numbers of blocks and volumes");
  const auto n_blocks = counts.take<std::uint64_t>(), n_maps = counts.take<std::uint64_t>();
  counts.finish();
  std::vector<SavedBlock> saved;
  for (std::uint64_t i = 0; i < n_blocks; ++i) saved.push_back(load_block(file.next(fmt::format("block {}", i))));
  std::vector<std::shared_ptr<TsdfBlock>> blocks(saved.size());  // of the maps' common settings: made where first used
  std::vector<MapHandle> maps;
  for (std::uint64_t i = 0; i < n_maps; ++i) {
    auto in = file.next(fmt::format("volume {}", i));
    auto map = std::make_shared<TsdfMap>(in.take<TsdfSettings>());
    for (const auto number : in.take<std::vector<std::uint32_t>>()) {
      if (number >= blocks.size()) in.fail("names a block that is not there");
      auto& block = blocks[number];
      auto& voxels = saved[number];
      if (!block) block = TsdfMap::make_block(map->settings(), voxels.place, voxels.tsdf, voxels.weight);
      map->add_block(voxels.place, block);
    }
    in.finish();
    map->index_blocks();
    maps.push_back(std::move(map));
  }
  return maps;
}

}  // namespace ppm
