#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "framework/slam/prediction.hpp"

namespace ppm {

class PpmMap;

/// Which element of a mesh map each pixel of a view shows, and where: the record of a back-end that finds hits one by
/// one. Row-major, one entry a pixel; where chunk is kNone the other entries mean nothing.
struct ElementHits {
  std::vector<float> range;   ///< m along the ray
  std::vector<float> u, v;    ///< barycentric, see Prediction::bary
  std::vector<float> facing;  ///< cosine between the ray's reverse and the face's normal: > 0 on the observed side
  std::vector<std::uint32_t> chunk, face;

  /// Sizes the arrays and makes all pixels misses. Keeps capacity.
  void reset(std::size_t pixels);
};

/// Sample i of a view from hit `at` of the record; colour where `out` has it. The map was looked at for the record.
void sample_hit(const PpmMap& map, bool linear_texels, const ElementHits& hits, std::size_t at, std::size_t i,
                ViewSamples& out);

/// Pixel p of a view's arrays from hit `at` of the record, which is one; colour where `out` has it. normal: unit, of the
/// face.
void fill_hit(const PpmMap& map, bool linear_texels, const ElementHits& hits, std::size_t at,
              const Eigen::Vector3f& normal, std::size_t p, Prediction& out);

/// A deferred view of a mesh map, made of such a record: attributes are read from the map's texels when asked for.
class ElementView final : public DeferredView {
 public:
  /// The view of a map before any hit is known. linear_texels: interpolate between texels; otherwise take the nearest.
  /// The map is not owned, see DeferredView.
  void start(const PpmMap& map, bool linear_texels, std::size_t pixels);
  ElementHits& hits() { return hits_; }

  void sample(const Prediction& view, std::span<const std::uint32_t> pixels, ViewSamples& out) const override;
  void fill(const Prediction& view, const Rows& rows, Prediction& out) const override;
  void elements(const Prediction& view, const Rows& rows, std::span<std::uint32_t> chunk,
                std::span<std::uint32_t> face) const override;

 private:
  const PpmMap* map_ = nullptr;
  bool linear_texels_ = true;
  ElementHits hits_;
};

}  // namespace ppm
