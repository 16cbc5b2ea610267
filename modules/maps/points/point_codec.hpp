#pragma once
#include "framework/slam/map_codec.hpp"

namespace ppm {

/// Keeps the point maps of a belief in checkpoints: tiles and tables of cells once each, whoever shares them.
class PointCodec final : public MapCodec {
 public:
  void save(const std::vector<const Map*>& maps, RecordFileWriter& file) const override;
  std::vector<MapHandle> load(RecordFileReader& file) const override;

 private:
  struct Shared;
  static MapHandle take_map(RecordReader& in, const Shared& shared);
};

}  // namespace ppm
