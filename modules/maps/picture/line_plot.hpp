#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

/// A quantity over the frames of a run.
struct PlotLine {
  std::string name;
  std::vector<Eigen::Vector2d> points;  ///< (frame, value), ascending frames; finite
};

/// Frames first .. last, both within.
struct PlotSpan {
  double first = 0, last = 0;
};

struct PlotSettings {
  int cols = 1200, panel_rows = 130;
};

/// Panels one below the other, one a line, over the same frames, each with its own scale of values and its name above.
/// shaded: frames that stand out in every panel. At least one line (InternalError).
RgbImage line_plot(const std::vector<PlotLine>& lines, const std::vector<PlotSpan>& shaded, const PlotSettings& settings);

/// Round values from low to high, both ends within, about `count` of them: steps of 1, 2 or 5 times a power of ten.
std::vector<double> round_values(double low, double high, int count);

}  // namespace ppm
