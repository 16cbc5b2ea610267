#pragma once
#include <vector>

#include "framework/slam/prediction.hpp"
#include "modules/prediction/element_view.hpp"
#include "modules/prediction/embree_scene.hpp"

namespace ppm {

class PpmMap;

/// How rays are traced and hits are read.
struct EmbreeViewOptions {
  int packet = 16;            ///< rays traced together: 1, 4, 8 or 16
  bool coherent = true;       ///< tells Embree that the rays of a packet go much the same way
  bool linear_texels = true;  ///< interpolate texels; otherwise take the nearest
  bool cull_back_faces = true;  ///< faces seen from behind are no hits, the ray goes on
};

/// Finds what rows of a view see of the map: packets of neighbouring pixels are traced through the scenes of the chunks
/// whose boxes they may meet, nearest box first, until no box is nearer than the hits. A pure function of its arguments:
/// the same bytes each time, however rows are grouped. view: its camera and pose are read; hits: sized for it, misses in
/// these rows. scenes: by chunk number, null for an empty chunk.
void trace_hits(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
                const Rows& rows, const Prediction& view, ElementHits& hits);

/// The same with all attributes, into rows of `out` (reset to misses; its camera and pose set). Colour is filled where
/// `out` has it; its channels must be the map's then.
void trace_view(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
                const Rows& rows, Prediction& out);

}  // namespace ppm
