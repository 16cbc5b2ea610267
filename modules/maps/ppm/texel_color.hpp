#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "framework/slam/color.hpp"
#include "modules/maps/ppm/texel_update.hpp"

namespace ppm {

/// What is known of a texel's colour before it is seen: mean and variance of a uniform distribution over 0 .. 1.
inline constexpr float kColorPriorMean = 0.5f, kColorPriorVariance = 1.0f / 12;

/// Whether an image is compared with the map for a change of exposure before it is fused.
enum class ColorExposure {
  fixed,  ///< no: the map takes colours as they are, the paper's form
  gain,   ///< its colours are divided by its gain over the map's, so that the map keeps the exposure it began with
};

struct ColorSettings {
  ColorExposure exposure = ColorExposure::gain;
  /// Standard deviation by which a texel's colour may change between two images that see it (lighting): a texel's
  /// variance has a floor, and old colours give way to new ones. 0: the paper's form.
  float drift = 0;
};

/// The colours of a frame on the grid of a view, for a map with colour.
class ColorView {
 public:
  /// channels: the map's; 0 makes an empty view. classes: pixels of class kOwnHit tell the exposure. Throws DataError
  /// where the map has colour and the frame has none.
  ColorView(const Frame& frame, const UpdateView& view, const std::vector<std::uint8_t>& classes, int channels,
            const ColorSettings& settings);

  int channels() const { return channels_; }
  bool empty() const { return channels_ == 0; }
  const float* at(std::size_t pixel) const { return &value_[static_cast<std::size_t>(channels_) * pixel]; }
  float variance() const { return variance_; }    ///< of a measured channel
  float drift_variance() const { return drift_; }  ///< that a texel gains before it is updated
  const ColorValue& gain() const { return gain_; }

 private:
  int channels_ = 0;
  float variance_ = 0, drift_ = 0;
  ColorValue gain_{1, 1, 1};
  std::vector<float> value_;  // [C*px]
};

/// The texels of one face, whose offsets have been updated (mean, variance) or are about to start, and whose colours
/// are.
struct ColorTexels {
  std::span<const float> mean, variance;
  std::span<float> color, color_variance;
};

/// The gather form for one face, as gather_face() does it for offsets: each node, where the described surface has it,
/// takes the colours of the four pixels around its image, of those whose depth lies within the gate. Every channel is
/// fused as a conjugate Gaussian; they share their variance.
void gather_color(const UpdateView& view, const ColorView& colors, const TexelSettings& settings,
                  const std::array<Eigen::Vector3f, 3>& corner, std::uint32_t divisions, float excess,
                  const ColorTexels& texels);

/// First colours of a new face, all assigned: what is known before it is seen, and then this image.
void start_color(const UpdateView& view, const ColorView& colors, const TexelSettings& settings,
                 const std::array<Eigen::Vector3f, 3>& corner, std::uint32_t divisions, float excess,
                 const ColorTexels& texels);

/// Updates the colours of the faces in view, after update_texels() with the same arguments; does nothing with an empty
/// ColorView.
void update_color(const UpdateView& view, const ColorView& colors, const std::vector<std::uint8_t>& classes,
                  const std::vector<FaceRef>& faces, const TexelSettings& settings, const Workers& workers,
                  PpmEdit& edit);

}  // namespace ppm
