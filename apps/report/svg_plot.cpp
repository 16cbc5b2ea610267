#include "apps/report/svg_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>

#include "apps/report/axis.hpp"
#include "apps/report/html_text.hpp"

namespace ppm::report {

namespace {

constexpr double kWidth = 640, kHeight = 330, kLeft = 62, kRight = 180, kTop = 34, kBottom = 46;
constexpr double kLabelHeight = 14;

constexpr std::array kColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#b8a800"};
constexpr std::array kDashes{"", "7 3", "2 3", "9 3 2 3"};

std::string stroke(int style) {
  const auto s = static_cast<std::size_t>(style);
  const std::string dashes = kDashes[s / kColors.size() % kDashes.size()];
  return fmt::format("stroke=\"{}\"{}", kColors[s % kColors.size()],
                     dashes.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dashes));
}

const char* color(int style) {
  return kColors[static_cast<std::size_t>(style) % kColors.size()];
}

/// Draws into one frame of axes; all coordinates in the SVG's units.
class Drawing {
 public:
  Drawing(const Plot& plot, Axis x, Axis y) : plot_(plot), x_(x), y_(y) {}

  std::string svg() {
    out_ = fmt::format(
        "<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n"
        "<text x=\"{}\" y=\"18\" class=\"head\">{}</text>\n",
        kWidth, kHeight, escaped(plot_.title), kLeft, escaped(plot_.title));
    axes();
    for (const auto& s : plot_.series) band(s);
    for (const auto& s : plot_.series) line(s);
    labels();
    return out_ + "</svg>\n";
  }

 private:
  const Plot& plot_;
  Axis x_, y_;
  std::string out_;

  double px(double x) const { return kLeft + x_.at(x) * (kWidth - kLeft - kRight); }
  double py(double y) const { return kHeight - kBottom - y_.at(y) * (kHeight - kTop - kBottom); }
  std::string point(double x, double y) const { return fmt::format("{:.1f},{:.1f}", px(x), py(y)); }

  void axes() {
    const double right = kWidth - kRight, bottom = kHeight - kBottom;
    for (const double t : y_.ticks())
      out_ +=
          fmt::format("<path class=\"grid\" d=\"M{} {:.1f}H{}\"/><text x=\"{}\" y=\"{:.1f}\" class=\"y\">{}</text>\n",
                      kLeft, py(t), right, kLeft - 6, py(t) + 4, tick_text(t));
    for (const double t : x_.ticks())
      out_ +=
          fmt::format("<path class=\"grid\" d=\"M{:.1f} {}V{}\"/><text x=\"{:.1f}\" y=\"{}\" class=\"x\">{}</text>\n",
                      px(t), kTop, bottom, px(t), bottom + 16, tick_text(t));
    out_ += fmt::format("<path class=\"axis\" d=\"M{} {}V{}H{}\"/>\n", kLeft, kTop, bottom, right);
    out_ += fmt::format("<text x=\"{}\" y=\"{}\" class=\"x\">{}</text>\n", (kLeft + right) / 2, kHeight - 8,
                        escaped(plot_.x_label));
    out_ += fmt::format("<text transform=\"translate(14 {}) rotate(-90)\" class=\"x\">{}</text>\n", (kTop + bottom) / 2,
                        escaped(plot_.y_label));
    if (plot_.unit_square)
      out_ += fmt::format("<path class=\"diagonal\" d=\"M{} {} L{} {}\"/>\n", kLeft, bottom, right, kTop);
  }

  void band(const PlotSeries& s) {
    if (s.low.empty() || s.low == s.high) return;
    std::string points;
    for (std::size_t k = 0; k < s.x.size(); ++k) points += point(s.x[k], s.high[k]) + " ";
    for (std::size_t k = s.x.size(); k-- > 0;) points += point(s.x[k], s.low[k]) + " ";
    out_ += fmt::format("<polygon points=\"{}\" fill=\"{}\" class=\"band\"/>\n", points, color(s.style));
  }

  void line(const PlotSeries& s) {
    std::string points;
    for (std::size_t k = 0; k < s.x.size(); ++k) points += point(s.x[k], s.y[k]) + " ";
    if (s.x.size() > 1) out_ += fmt::format("<polyline points=\"{}\" {} class=\"line\"/>\n", points, stroke(s.style));
    if (!s.marks && s.x.size() > 1) return;
    for (std::size_t k = 0; k < s.x.size(); ++k)
      out_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", px(s.x[k]), py(s.y[k]),
                          color(s.style));
  }

  /// Names at the ends of the lines, in the order of the ends, pushed apart where they would overlap.
  void labels() {
    std::vector<const PlotSeries*> order;
    for (const auto& s : plot_.series)
      if (!s.x.empty()) order.push_back(&s);
    std::ranges::stable_sort(order, {}, [&](const auto* s) { return py(s->y.back()); });
    std::vector<double> at;
    for (const auto* s : order) at.push_back(std::max(py(s->y.back()), at.empty() ? kTop : at.back() + kLabelHeight));
    double below = kHeight - 6;
    for (std::size_t k = at.size(); k-- > 0;) below = (at[k] = std::min(at[k], below)) - kLabelHeight;
    const double edge = kWidth - kRight;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto& s = *order[k];
      out_ += fmt::format(
          "<path d=\"M{:.1f} {:.1f}L{} {:.1f}\" class=\"leader\"/>"
          "<path d=\"M{} {:.1f}h18\" {} class=\"line\"/><text x=\"{}\" y=\"{:.1f}\">{}</text>\n",
          px(s.x.back()), py(s.y.back()), edge + 10, at[k], edge + 10, at[k], stroke(s.style), edge + 32, at[k] + 4,
          escaped(s.label));
    }
  }
};

std::vector<double> all_of(const Plot& plot, std::vector<double> PlotSeries::*values) {
  std::vector<double> all;
  for (const auto& s : plot.series) all.insert(all.end(), (s.*values).begin(), (s.*values).end());
  return all;
}

}  // namespace

std::string svg_plot(const Plot& plot) {
  if (plot.unit_square) return Drawing(plot, Axis(0, 1), Axis(0, 1)).svg();
  auto ys = all_of(plot, &PlotSeries::y);
  for (auto bound : {&PlotSeries::low, &PlotSeries::high}) {
    const auto more = all_of(plot, bound);
    ys.insert(ys.end(), more.begin(), more.end());
  }
  if (!plot.log_y) ys.push_back(0);
  auto scale = [](bool logarithmic) { return logarithmic ? Scale::logarithmic : Scale::linear; };
  return Drawing(plot, Axis(all_of(plot, &PlotSeries::x), scale(plot.log_x)), Axis(ys, scale(plot.log_y))).svg();
}

bool wants_log(const std::vector<PlotSeries>& series) {
  std::vector<double> ys;
  for (const auto& s : series)
    for (const double y : s.y)
      if (y > 0) ys.push_back(y);
  if (ys.empty()) return false;
  std::ranges::sort(ys);
  return ys[ys.size() * 9 / 10] > 8 * ys[ys.size() / 10];
}

}  // namespace ppm::report
