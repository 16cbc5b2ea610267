#pragma once
#include <span>
#include <vector>

#include "framework/slam/prediction.hpp"
#include "modules/maps/ppm/visible_chunks.hpp"
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

/// A deferred view that traces rays only through the pixels that it is asked for: where a likelihood compares few of an
/// image. Pixels are traced with their neighbours among those that are asked for.
class EmbreeRays final : public DeferredView {
 public:
  /// Map and scenes are not owned, see DeferredView. view: its camera and pose are read.
  void start(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
             const Prediction& view);
  void sample(const Prediction& view, std::span<const std::uint32_t> pixels, ViewSamples& out) const override;
  void fill(const Prediction& view, const Rows& rows, Prediction& out) const override;

 private:
  const PpmMap* map_ = nullptr;
  const std::vector<const EmbreeScene*>* scenes_ = nullptr;
  EmbreeViewOptions options_;
  std::vector<VisibleChunk> visible_;
};

}  // namespace ppm
