#pragma once
#include "framework/slam/map_codec.hpp"

namespace ppm {

/// Keeps OctoMaps in checkpoints: every node of every tree.
class OctomapCodec final : public MapCodec {
 public:
  void save(const std::vector<const Map*>& maps, RecordFileWriter& file) const override;
  std::vector<MapHandle> load(RecordFileReader& file) const override;
};

}  // namespace ppm
