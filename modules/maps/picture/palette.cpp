#include "modules/maps/picture/palette.hpp"

#include <algorithm>
#include <map>
#include <span>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

struct Tint {
  Rgb color{};
  std::int64_t pixels = 0;
};

/// Colours that are to become one, and the channel in which they differ most.
struct Box {
  std::span<Tint> tints;
  std::size_t channel = 0;
  double error = 0;  ///< squared, in that channel, over all pixels
};

double mean(std::span<const Tint> tints, std::size_t channel) {
  std::int64_t sum = 0, pixels = 0;
  for (const auto& tint : tints) {
    sum += tint.pixels * tint.color[channel];
    pixels += tint.pixels;
  }
  return static_cast<double>(sum) / static_cast<double>(pixels);
}

Box box_of(std::span<Tint> tints) {
  Box box{tints};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double middle = mean(tints, channel);
    double error = 0;
    for (const auto& tint : tints) {
      const double off = tint.color[channel] - middle;
      error += static_cast<double>(tint.pixels) * off * off;
    }
    if (error > box.error) box = {tints, channel, error};
  }
  return box;
}

std::vector<Box> boxes_of(std::vector<Tint>& tints, std::size_t most) {
  std::vector<Box> boxes{box_of(tints)};
  while (boxes.size() < most) {
    auto& worst = *std::ranges::max_element(boxes, {}, &Box::error);
    if (worst.error <= 0) break;
    const auto all = worst.tints;
    const double middle = mean(all, worst.channel);
    const auto right = std::stable_partition(all.begin(), all.end(),
                                             [&](const Tint& tint) { return tint.color[worst.channel] <= middle; });
    worst = box_of({all.begin(), right});
    boxes.push_back(box_of({right, all.end()}));
  }
  return boxes;
}

Rgb pixel(const RgbImage& image, std::size_t i) {
  return {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]};
}

}  // namespace

PaletteImage in_palette(const RgbImage& image, int most_colors) {
  PPM_CHECK(2 <= most_colors && most_colors <= 256, "{} colours", most_colors);
  PPM_CHECK(!image.rgb.empty(), "a picture without pixels");
  const std::size_t pixels = image.rgb.size() / 3;
  std::map<Rgb, std::int64_t> counts;
  for (std::size_t i = 0; i < pixels; ++i) ++counts[pixel(image, i)];
  std::vector<Tint> tints;
  for (const auto& [color, count] : counts) tints.push_back({color, count});

  PaletteImage out{image.cols, image.rows, {}, {}};
  std::map<Rgb, std::uint8_t> index;
  for (const auto& box : boxes_of(tints, static_cast<std::size_t>(most_colors))) {
    for (const auto& tint : box.tints) index[tint.color] = static_cast<std::uint8_t>(out.palette.size());
    Rgb color{};
    for (std::size_t channel = 0; channel < 3; ++channel)
      color[channel] = static_cast<std::uint8_t>(mean(box.tints, channel) + 0.5);
    out.palette.push_back(color);
  }
  for (std::size_t i = 0; i < pixels; ++i) out.index.push_back(index.at(pixel(image, i)));
  return out;
}

}  // namespace ppm
