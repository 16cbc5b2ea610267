#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/slam/mesh.hpp"
#include "modules/maps/picture/rgb_image.hpp"
#include "modules/maps/picture/show.hpp"

namespace ppm {

/// Ends of a colour scale, m.
struct ScaleRange {
  float low = 0, high = 0;
};

/// Lengths as colours, perceptually uniform: for sigma logarithmic, from dark blue to yellow; for the mean linear, from
/// blue over grey (0) to red; for other lengths linear, from dark blue to yellow. Values beyond the ends have the ends' colours.
/// Source: viridis (Smith, van der Walt, Firing, 2015); cool-warm (Moreland, "Diverging color maps for scientific
/// visualization", 2009).
class ColorScale {
 public:
  /// show: sigma or mean. The range must ascend and for sigma be positive (InternalError).
  ColorScale(Show show, ScaleRange range);
  /// Of another length. The range must ascend (InternalError).
  ColorScale(std::string title, ScaleRange range);
  Color color(float value_m) const;
  Color at(float position) const;        ///< of a position in [0, 1]
  float position(float value_m) const;   ///< in [0, 1]
  std::vector<float> ticks() const;      ///< m: a few round values from end to end
  const std::string& title() const { return title_; }  ///< "standard deviation of the surface"
  bool logarithmic() const { return form_ == Form::logarithmic; }
  const ScaleRange& range() const { return range_; }

 private:
  enum class Form { logarithmic, diverging, linear };
  Form form_;
  std::string title_;
  ScaleRange range_;
};

/// The range that holds all but the outermost hundredth of the mesh's values at each end, rounded outwards to 1, 2, 5
/// times a power of ten; for the mean symmetric.
ScaleRange scale_range(const Mesh& mesh, Show show);
/// The scale for what is shown, with the mesh's own range where none is given; none for normals, colour and shading.
std::optional<ColorScale> scale_for(const Mesh& mesh, Show show, const std::optional<ScaleRange>& range);

Color normal_color(const Eigen::Vector3f& normal);
/// [V] what is to be shown at each vertex; empty for Show::shaded, and for Show::color where the mesh has none.
std::vector<Color> vertex_colors(const Mesh& mesh, Show show, const std::optional<ColorScale>& scale);

/// "0.2 mm", "-5 cm", "1 m".
std::string length_text(float value_m);

}  // namespace ppm
