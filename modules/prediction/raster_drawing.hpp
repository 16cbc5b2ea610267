#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "modules/prediction/raster_view.hpp"

namespace ppm {

/// Memory for drawing, one a worker.
struct RasterScratch {
  struct Chunk {
    std::uint32_t number;
    float distance;  ///< m^2, squared, from the camera's centre to the chunk's box
  };
  std::vector<Chunk> chunks;
  AlignedArray<float> vertex;         ///< see raster_project
  AlignedArray<float> inverse_depth;  ///< see raster_draw
  RasterBoxes boxes;
};

/// Draws rows of a view that was started: chunks in the image, nearest first. A pure function of its arguments: the
/// same pixels each time, however rows are grouped.
void draw_rows(const Rows& rows, RasterView& view, RasterScratch& scratch);

/// Starts and draws views for a ViewPredictor, with memory that is used again.
class RasterDrawer {
 public:
  void prepare(const Workers& workers) { scratch_.resize(workers.threads()); }
  /// See ViewPredictor::defer().
  std::shared_ptr<DeferredView> start(const PpmMap& map, const Prediction& out, const RasterOptions& options) {
    auto view = views_.take();
    view->start(map, out, options);
    return view;
  }
  /// Draws rows of a view that start() gave. One caller a worker, after prepare().
  void draw(const Rows& rows, Prediction& out, int worker) {
    draw_rows(rows, static_cast<RasterView&>(*out.deferred), scratch_[worker]);
  }

 private:
  Pool<RasterView> views_;
  PerWorker<RasterScratch> scratch_;
};

}  // namespace ppm
