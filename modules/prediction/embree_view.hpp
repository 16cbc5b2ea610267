#pragma once
#include <vector>

#include "framework/slam/prediction.hpp"
#include "modules/prediction/embree_scene.hpp"

namespace ppm {

class PpmMap;

/// How rays are traced and hits are read.
struct EmbreeViewOptions {
  int packet = 16;            ///< rays traced together: 1, 4, 8 or 16
  bool coherent = true;       ///< tells Embree that the rays of a packet go much the same way
  bool linear_texels = true;  ///< interpolate texels; otherwise take the nearest
};

/// Fills rows of `out` (reset to misses; its camera and pose set) with what its camera sees of the map: packets of
/// neighbouring pixels are traced through the scenes of the chunks whose boxes they may meet, nearest box first, until
/// no box is nearer than the hits. A pure function of its arguments: the same bytes each time, however rows are
/// grouped. Colour is filled where `out` has it; its channels must be the map's then. scenes: by chunk number, null for an empty chunk.
void trace_view(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
                const Rows& rows, Prediction& out);

}  // namespace ppm
