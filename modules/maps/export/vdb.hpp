#pragma once
#include <string>

#include "framework/slam/mesh.hpp"

namespace ppm {

/// The bytes of a VDB file with two grids around the surface, active up to `band` voxels from it: "distance", m,
/// unsigned, to the nearest point of the mesh (the surface is open: it has no inside), exact beside the surface and up to
/// half a voxel too large two or three voxels away, and "sigma", m, the standard deviation of the surface there. voxel_m: edge of a voxel; voxel (i, j, k) is centred at voxel_m * (i, j, k) in the
/// map frame.
/// Source: Museth, "VDB: high-resolution sparse volumes with dynamic topology", ACM TOG 32(3), 2013.
std::string to_vdb(const Mesh& mesh, double voxel_m, float band = 3);

}  // namespace ppm
