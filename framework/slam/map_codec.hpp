#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/record_file.hpp"
#include "framework/slam/map.hpp"

namespace ppm {

/// How the maps of one kind are kept in a checkpoint. Given by the module that makes such maps (Registry::add_map_kind).
class MapCodec {
 public:
  virtual ~MapCodec() = default;
  /// Writes distinct maps of the kind as any number of records: what several share, once.
  virtual void save(const std::vector<const Map*>& maps, RecordFileWriter& file) const = 0;
  /// Reads them back in the same order: the same content and, part by part, shared as before, so that Map::account()
  /// gives the same bytes. Throws DataError.
  virtual std::vector<MapHandle> load(RecordFileReader& file) const = 0;
};

/// By kind, see Map::kind.
using MapCodecs = std::map<std::string, std::shared_ptr<const MapCodec>>;

}  // namespace ppm
