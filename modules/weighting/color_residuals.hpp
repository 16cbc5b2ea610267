#pragma once
#include <vector>

#include "framework/slam/color.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/measured_pixels.hpp"

namespace ppm {

/// Whether a view's colours are compared as they are, or after the image was divided by its gain over the view: a
/// camera's automatic exposure changes all pixels together, and says nothing of the pose.
enum class CompareColor { gain, fixed };

/// Measured minus predicted colours, one entry a measured pixel; 0 where the map shows nothing.
struct ColorResiduals {
  std::vector<ColorValue> residual;
  std::vector<float> map_variance;  ///< of each channel, by the map alone
  float sensor_variance = 0;        ///< of each channel, after division by the gain

  /// Throws ConfigError where the view has no colour, DataError where the frame has none.
  ColorResiduals(const Frame& frame, const MeasuredPixels& measured, const ViewSamples& expected,
                 CompareColor exposure);
};

}  // namespace ppm
