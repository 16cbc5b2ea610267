#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ppm::report {

/// A line with a band around it.
struct PlotSeries {
  std::string label;
  int style = 0;  ///< colour and dashes: the same for a graph in all plots
  std::vector<double> x, y;
  std::vector<double> low, high;  ///< of the band; empty: none
  bool marks = false;             ///< a dot at each point
};

struct Plot {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  bool unit_square = false;  ///< both axes from 0 to 1, with the diagonal
  std::vector<PlotSeries> series;
};

/// The plot as an <svg> element: axes with round ticks, lines, and a label at the end of each line. Colours are those
/// of Okabe and Ito, which colour-blind people tell apart; from the ninth series on lines are dashed. source: Okabe and
/// Ito, Color universal design (2008), https://jfly.uni-koeln.de/color/
std::string svg_plot(const Plot& plot);

/// Whether values are so far apart that only a logarithmic axis shows them: the 90th percentile above 8 times the 10th.
bool wants_log(const std::vector<PlotSeries>& series);

}  // namespace ppm::report
