#include "modules/maps/picture/color_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>

#include "framework/core/error.hpp"
#include "modules/maps/picture/line_plot.hpp"

namespace ppm {
namespace {

using Stops = std::array<std::array<float, 3>, 11>;
constexpr Stops kViridis{{{0.267f, 0.005f, 0.329f},
                          {0.283f, 0.141f, 0.458f},
                          {0.254f, 0.265f, 0.530f},
                          {0.207f, 0.372f, 0.553f},
                          {0.164f, 0.471f, 0.558f},
                          {0.128f, 0.567f, 0.551f},
                          {0.135f, 0.659f, 0.518f},
                          {0.267f, 0.749f, 0.441f},
                          {0.478f, 0.821f, 0.318f},
                          {0.741f, 0.873f, 0.150f},
                          {0.993f, 0.906f, 0.144f}}};
constexpr Stops kCoolWarm{{{0.230f, 0.299f, 0.754f},
                           {0.348f, 0.466f, 0.888f},
                           {0.484f, 0.622f, 0.975f},
                           {0.619f, 0.744f, 0.999f},
                           {0.754f, 0.830f, 0.961f},
                           {0.867f, 0.864f, 0.863f},
                           {0.947f, 0.795f, 0.717f},
                           {0.968f, 0.674f, 0.557f},
                           {0.932f, 0.519f, 0.406f},
                           {0.839f, 0.322f, 0.265f},
                           {0.706f, 0.016f, 0.150f}}};

/// 1, 2 or 5 times a power of ten, in ascending order, by number: 0 is 1, 1 is 2, 2 is 5, 3 is 10.
double round_value(int number) {
  static constexpr std::array<double, 3> kMantissa{1, 2, 5};
  const int decade = static_cast<int>(std::floor(number / 3.0));
  return kMantissa[static_cast<std::size_t>(number - 3 * decade)] * std::pow(10.0, decade);
}
int round_down(double value) {
  int n = 3 * static_cast<int>(std::floor(std::log10(value)));
  while (round_value(n + 1) <= value * (1 + 1e-6)) ++n;
  return n;
}
int round_up(double value) {
  const int n = round_down(value);
  return round_value(n) >= value * (1 - 1e-6) ? n : n + 1;
}

float quantile_of(std::vector<float>& values, double share) {
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

}  // namespace

ColorScale::ColorScale(Show show, ScaleRange range)
    : form_(show == Show::sigma ? Form::logarithmic : Form::diverging),
      title_(show == Show::sigma ? "standard deviation of the surface" : "offset of the surface from the faces"),
      range_(range) {
  PPM_CHECK(show == Show::sigma || show == Show::mean, "no scale for {}", to_string(show));
  PPM_CHECK(range.low < range.high && (show == Show::mean || range.low > 0), "range {} .. {}", range.low, range.high);
}

ColorScale::ColorScale(std::string title, ScaleRange range) : form_(Form::linear), title_(std::move(title)), range_(range) {
  PPM_CHECK(range.low < range.high, "range {} .. {}", range.low, range.high);
}

float ColorScale::position(float value) const {
  const float x = form_ == Form::logarithmic
                      ? std::log(std::max(value, range_.low) / range_.low) / std::log(range_.high / range_.low)
                      : (value - range_.low) / (range_.high - range_.low);
  return std::clamp(x, 0.0f, 1.0f);
}

Color ColorScale::at(float position) const {
  const Stops& stops = form_ == Form::diverging ? kCoolWarm : kViridis;
  const float x = std::clamp(position, 0.0f, 1.0f) * static_cast<float>(stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), stops.size() - 2);
  const float w = x - static_cast<float>(i);
  return (1 - w) * Eigen::Map<const Color>(stops[i].data()) + w * Eigen::Map<const Color>(stops[i + 1].data());
}

Color ColorScale::color(float value) const {
  return at(position(value));
}

std::vector<float> ColorScale::ticks() const {
  if (form_ == Form::linear) {
    const auto values = round_values(range_.low, range_.high, 6);
    return {values.begin(), values.end()};
  }
  if (form_ == Form::diverging) {
    const float middle = (range_.low + range_.high) / 2;
    return {range_.low, (range_.low + middle) / 2, middle, (middle + range_.high) / 2, range_.high};
  }
  const int first = round_up(range_.low), last = round_down(range_.high);
  const int step = last - first > 6 ? 3 : 1;  // decades only, where there are many
  std::vector<float> ticks;
  for (int n = first; n <= last; n += step) ticks.push_back(static_cast<float>(round_value(n)));
  return ticks;
}

ScaleRange scale_range(const Mesh& mesh, Show show) {
  const bool sigma = show == Show::sigma;
  if (mesh.position.empty()) return sigma ? ScaleRange{1e-3f, 1e-1f} : ScaleRange{-1e-2f, 1e-2f};
  std::vector<float> values;
  values.reserve(mesh.mean.size());
  for (std::size_t v = 0; v < mesh.mean.size(); ++v)
    values.push_back(sigma ? std::sqrt(mesh.variance[v]) : std::abs(mesh.mean[v]));
  const auto most = round_value(round_up(std::max(quantile_of(values, 0.99), 1e-6f)));
  if (!sigma) return {static_cast<float>(-most), static_cast<float>(most)};
  const auto least = round_value(round_down(std::max(quantile_of(values, 0.01), 1e-6f)));
  return {static_cast<float>(least), static_cast<float>(std::max(most, 2 * least))};
}

std::optional<ColorScale> scale_for(const Mesh& mesh, Show show, const std::optional<ScaleRange>& range) {
  if (show != Show::sigma && show != Show::mean) return std::nullopt;
  return ColorScale(show, range ? *range : scale_range(mesh, show));
}

Color normal_color(const Eigen::Vector3f& normal) {
  return 0.5f * (normal + Color::Ones());
}

std::vector<Color> vertex_colors(const Mesh& mesh, Show show, const std::optional<ColorScale>& scale) {
  if (show == Show::shaded) return {};
  if (show == Show::color) return mesh.color;
  std::vector<Color> colors;
  colors.reserve(mesh.position.size());
  for (std::size_t v = 0; v < mesh.position.size(); ++v)
    colors.push_back(show == Show::normal ? normal_color(mesh.normal[v])
                     : show == Show::mean ? scale->color(mesh.mean[v])
                                          : scale->color(std::sqrt(mesh.variance[v])));
  return colors;
}

std::string length_text(float value) {
  const float size = std::abs(value);
  if (size == 0) return "0";
  if (size < 0.999e-4f) return fmt::format("{:g} um", std::round(value * 1e7f) / 10);
  if (size < 0.999e-2f) return fmt::format("{:g} mm", std::round(value * 1e4f) / 10);
  if (size < 0.999f) return fmt::format("{:g} cm", std::round(value * 1e3f) / 10);
  return fmt::format("{:g} m", std::round(value * 1e2f) / 100);
}

}  // namespace ppm
