#include "modules/maps/picture/line_plot.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "framework/core/error.hpp"
#include "modules/maps/picture/stroke.hpp"
#include "modules/maps/picture/stroke_text.hpp"

namespace ppm {
namespace {

constexpr double kLeft = 76, kRight = 16, kAbove = 22, kBelow = 6, kText = 9, kFoot = 30;
const Color kInk(0.15f, 0.16f, 0.18f), kGrid(0.88f, 0.89f, 0.90f), kCurve(0.09f, 0.36f, 0.62f),
    kShade(1.0f, 0.85f, 0.82f);

/// Values and where they are drawn, along one axis.
struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double at_low = 0, at_high = 1;  // px

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// An axis of nothing, or of one value, gets a length.
  void widen() {
    if (low > high) low = high = 0;
    if (low == high) {
      const double margin = low == 0 ? 1 : 0.1 * std::abs(low);
      low -= margin;
      high += margin;
    }
  }
  double px(double value) const { return at_low + (value - low) / (high - low) * (at_high - at_low); }
};

void shade(RgbImage& image, double x0, double x1, double y0, double y1) {
  const auto bytes = to_bytes(kShade);
  for (int y = static_cast<int>(y0); y <= static_cast<int>(y1); ++y)
    for (int x = static_cast<int>(x0); x <= static_cast<int>(x1); ++x)
      std::copy(bytes.begin(), bytes.end(),
                &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.cols) +
                                static_cast<std::size_t>(x))]);
}

void draw_panel(RgbImage& image, const PlotLine& line, const Axis& frames, const Axis& values,
                const std::vector<PlotSpan>& shaded) {
  for (const auto& span : shaded) {
    const double half = 0.5, x0 = std::clamp(frames.px(span.first - half), frames.at_low, frames.at_high),
                 x1 = std::clamp(frames.px(span.last + half), frames.at_low, frames.at_high);
    shade(image, x0, x1, values.at_high, values.at_low);
  }
  for (double v : round_values(values.low, values.high, 4)) {
    const auto label = fmt::format("{:.4g}", v);
    draw_stroke(image, {frames.at_low, values.px(v)}, {frames.at_high, values.px(v)}, 1, kGrid);
    draw_text(image, label, frames.at_low - 8 - text_width(label, kText), values.px(v) - kText / 2, kText, kInk);
  }
  for (double f : round_values(frames.low, frames.high, 10))
    draw_stroke(image, {frames.px(f), values.at_low}, {frames.px(f), values.at_high}, 1, kGrid);
  draw_stroke(image, {frames.at_low, values.at_low}, {frames.at_high, values.at_low}, 1, kInk);
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
    draw_stroke(image, {frames.px(line.points[i].x()), values.px(line.points[i].y())},
                {frames.px(line.points[i + 1].x()), values.px(line.points[i + 1].y())}, 1.4, kCurve);
  draw_text(image, line.name, frames.at_low, values.at_high - kText - 5, kText, kInk);
}

}  // namespace

std::vector<double> round_values(double low, double high, int count) {
  const double rough = (high - low) / count, power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough) step = factor * power;
  std::vector<double> values;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    values.push_back(k * step + 0.0);  // no -0
  return values;
}

RgbImage line_plot(const std::vector<PlotLine>& lines, const std::vector<PlotSpan>& shaded,
                   const PlotSettings& settings) {
  PPM_CHECK(!lines.empty(), "a plot of no line");
  const int rows = static_cast<int>(lines.size()) * settings.panel_rows + static_cast<int>(kFoot);
  RgbImage image{settings.cols, rows, {}};
  image.rgb.assign(3 * static_cast<std::size_t>(image.cols) * static_cast<std::size_t>(rows), 255);
  Axis frames;
  frames.at_low = kLeft;
  frames.at_high = settings.cols - kRight;
  for (const auto& line : lines)
    for (const auto& p : line.points) frames.include(p.x());
  frames.widen();
  for (std::size_t k = 0; k < lines.size(); ++k) {
    Axis values;
    for (const auto& p : lines[k].points) values.include(p.y());
    values.widen();
    const double top = static_cast<double>(k) * settings.panel_rows;
    values.at_low = top + settings.panel_rows - kBelow;
    values.at_high = top + kAbove;
    draw_panel(image, lines[k], frames, values, shaded);
  }
  for (double f : round_values(frames.low, frames.high, 10)) {
    const auto label = fmt::format("{:.6g}", f);
    draw_text(image, label, frames.px(f) - text_width(label, kText) / 2, rows - kFoot + 6, kText, kInk);
  }
  return image;
}

}  // namespace ppm
