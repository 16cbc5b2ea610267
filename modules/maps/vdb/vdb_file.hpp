#pragma once
#include <string>

#include "modules/maps/vdb/vdb_map.hpp"

namespace ppm {

/// The map as a .vdb file's bytes, for OpenVDB's own programs and those that read its files. Two grids of OpenVDB's
/// common configuration (5-4-3, float), in the map frame:
/// log_odds   active where something is known; what is constant over 8^3 voxels stays a tile
/// occupancy  the probability, a fog volume: active where a voxel is likelier occupied than free, 0 elsewhere
std::string vdb_file(const VdbMap& map);

}  // namespace ppm
