#pragma once
#include "framework/slam/mesh.hpp"
#include "modules/maps/vdb/vdb_map.hpp"

namespace ppm {

/// The faces between voxels that are likelier occupied and those that are likelier free, two triangles each, seen from
/// the free side. No faces towards what is unknown. variance: of a place that may be anywhere in a voxel,
/// voxel_size^2 / 12.
Mesh voxel_faces(const VdbMap& map);

/// The surface where log-odds, linear between neighbouring voxel centres, pass 0: a vertex for each cube of eight centres
/// that it passes (the mean of its crossings of the cube's edges), a quad for each crossed edge. Edges with an unknown end
/// are not crossed. variance: as above, although a voxel seen often is known better.
/// Source: Gibson, "Constrained Elastic Surface Nets", MICCAI 1998.
Mesh zero_surface(const VdbMap& map);

}  // namespace ppm
