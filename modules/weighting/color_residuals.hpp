#pragma once
#include <cstddef>

#include "framework/slam/color.hpp"
#include "framework/slam/pixel_block.hpp"

namespace ppm {

/// Whether a view's colours are compared as they are, or after the image was divided by its gain over the view: a
/// camera's automatic exposure changes all pixels together, and says nothing of the pose. The gain is that of a block
/// of pixels, which is to be the whole view (Weighting::kWholeView).
enum class CompareColor { gain, fixed };

/// Measured minus predicted colours of a block of pixels, which must outlive it.
class ColorResiduals {
 public:
  /// Throws ConfigError where the view has no colour, DataError where the frame has none.
  ColorResiduals(const PixelBlock& pixels, CompareColor exposure);

  /// Of a pixel where the map shows something.
  ColorValue residual(std::size_t i) const;
  float sensor_variance() const { return sensor_variance_; }  ///< of each channel, after division by the gain
  std::size_t channels() const { return static_cast<std::size_t>(pixels_.expected.color_channels); }

 private:
  ColorValue measured(std::size_t i) const;
  ColorValue expected(std::size_t i) const;

  const PixelBlock& pixels_;
  ColorValue gain_{1, 1, 1};
  float sensor_variance_ = 0;
};

}  // namespace ppm
