#include "modules/maps/vdb/vdb_file.hpp"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <sstream>

#include "modules/maps/vdb/vdb_reader.hpp"

namespace ppm {
namespace {

using Grid = openvdb::FloatGrid;

Grid::Ptr grid_of(const VdbMap& map, const char* name) {
  auto grid = Grid::create(0.0f);
  const double h = map.settings().voxel_size_m;
  auto transform = openvdb::math::Transform::createLinearTransform(h);
  transform->postTranslate(openvdb::Vec3d(h / 2));  // OpenVDB's voxels are said of their index, ours of their centre
  grid->setTransform(transform);
  grid->setName(name);
  grid->setCreator("ppm");
  return grid;
}

/// Writes a leaf as `value` makes it of codes. value: returns whether the voxel is active.
template <class Value>
void add_leaf(Grid& grid, const openvdb::Coord& at, const VdbReader::Leaf& leaf, const Value& value) {
  float out = 0;
  if (!leaf.codes) {
    if (value(leaf.constant, out)) grid.tree().addTile(1, at, out, true);
    return;
  }
  auto* to = grid.tree().touchLeaf(at);
  for (int i = 0; i < kVdbLeafVoxels; ++i)
    if (value(leaf.codes[i], out)) to->setValueOn(static_cast<openvdb::Index>(i), out);
}

}  // namespace

std::string vdb_file(const VdbMap& map) {
  openvdb::initialize();
  const auto log_odds = grid_of(map, "log_odds"), occupancy = grid_of(map, "occupancy");
  occupancy->setGridClass(openvdb::GRID_FOG_VOLUME);
  log_odds->insertMeta("log_odds_min", openvdb::FloatMetadata(map.settings().log_odds_min));
  log_odds->insertMeta("log_odds_max", openvdb::FloatMetadata(map.settings().log_odds_max));
  const auto known = [&](VdbCode code, float& out) {
    out = static_cast<float>(code) * map.step();
    return code != kVdbUnknown;
  };
  const auto occupied = [&](VdbCode code, float& out) {
    out = 1 / (1 + std::exp(-static_cast<float>(code) * map.step()));
    return code > 0;
  };
  VdbReader reader(map);
  for (std::size_t c = 0; c < map.table().size(); ++c)
    for (int n = 0; n < kVdbTileLeaves; ++n) {
      const Cell at = map.table().cell(c) * kVdbTileEdge + VdbTile::offset(n);
      const auto leaf = reader.leaf(at.x(), at.y(), at.z());
      add_leaf(*log_odds, {at.x(), at.y(), at.z()}, leaf, known);
      add_leaf(*occupancy, {at.x(), at.y(), at.z()}, leaf, occupied);
    }
  for (const auto& grid : {log_odds, occupancy}) grid->pruneGrid();
  std::ostringstream bytes;
  openvdb::io::Stream(bytes).write(openvdb::GridPtrVec{log_odds, occupancy});
  return std::move(bytes).str();
}

}  // namespace ppm
