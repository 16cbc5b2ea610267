#pragma once
#include "framework/slam/map_codec.hpp"

namespace ppm {

/// Keeps TSDF maps in checkpoints: blocks once each, whoever shares them.
class TsdfCodec final : public MapCodec {
 public:
  void save(const std::vector<const Map*>& maps, RecordFileWriter& file) const override;
  std::vector<MapHandle> load(RecordFileReader& file) const override;
};

}  // namespace ppm
