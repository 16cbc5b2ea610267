#pragma once
#include <memory>
#include <mutex>
#include <vector>

#include "framework/slam/prediction.hpp"
#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/prediction/raster_kernels.hpp"

namespace ppm {

/// How a view is drawn and read.
struct RasterOptions {
  bool cull_back_faces = true;  ///< faces seen from behind are not drawn
  bool linear_texels = true;    ///< interpolate texels; otherwise take the nearest
};

/// A view that is drawn in bands of rows, each with the triangles that it shows. Attributes are found from them and
/// from the map's texels when asked for.
class RasterView final : public DeferredView {
 public:
  /// Forgets what was drawn before, keeps its memory.
  void start(const PpmMap& map, const Prediction& view, const RasterOptions& options);
  /// An empty band for these rows, to be drawn by one thread. Several threads may ask, for distinct rows.
  RasterBand& add_band(const Rows& rows);
  const PpmMap& map() const { return *map_; }
  const RasterCamera& camera() const { return camera_; }

  void sample(const Prediction& view, std::span<const std::uint32_t> pixels, ViewSamples& out) const override;
  void fill(const Prediction& view, const Rows& rows, Prediction& out) const override;
  void elements(const Prediction& view, const Rows& rows, std::span<std::uint32_t> chunk,
                std::span<std::uint32_t> face) const override;

 private:
  /// Calls body(lookup, first) for consecutive parts of the pixels, looked up.
  template <class Body>
  void look_up(const RasterQuestion& question, std::span<const std::uint32_t> pixels, const Body& body) const;

  RasterQuestion question(bool along_ray) const;

  const PpmMap* map_ = nullptr;
  RasterOptions options_;
  RasterCamera camera_{};
  std::mutex mutex_;  // guards the next two
  std::vector<std::unique_ptr<RasterBand>> bands_;
  std::size_t bands_used_ = 0;
  std::vector<const RasterBand*> band_of_row_;  // null: not drawn
};

}  // namespace ppm
