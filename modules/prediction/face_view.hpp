#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "framework/slam/prediction.hpp"
#include "modules/prediction/face_numbers.hpp"

namespace ppm {

/// The faces that a view shows.
struct ShownFaces {
  std::shared_ptr<const FaceNumbers> faces;                 ///< of the map
  std::shared_ptr<const std::vector<std::uint32_t>> drawn;  ///< owns what `number` refers to
  std::span<const std::uint32_t> number;                    ///< [rows*cols], by `faces`; FaceNumbers::kNone = nothing
};

/// A deferred view of a mesh map of which a rasterizer drew the faces' numbers: where rays meet them, and the texels
/// there, are found when asked for.
class FaceView final : public DeferredView {
 public:
  /// linear_texels: interpolate between texels; otherwise take the nearest. The map is not owned, see DeferredView.
  FaceView(const PpmMap& map, bool linear_texels, ShownFaces shown)
      : map_(map), linear_texels_(linear_texels), shown_(std::move(shown)) {}

  void sample(const Prediction& view, std::span<const std::uint32_t> pixels, ViewSamples& out) const override;
  void fill(const Prediction& view, const Rows& rows, Prediction& out) const override;
  void elements(const Prediction& view, const Rows& rows, std::span<std::uint32_t> chunk,
                std::span<std::uint32_t> face) const override;

 private:
  const PpmMap& map_;
  bool linear_texels_;
  ShownFaces shown_;
};

}  // namespace ppm
