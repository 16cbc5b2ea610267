#include "modules/maps/picture/legend.hpp"

#include "modules/maps/picture/stroke_text.hpp"

namespace ppm {
namespace {

/// A rectangle of a picture, px; what of it lies outside is left out.
struct Box {
  int left, top, cols, rows;
};

/// Gives each pixel of a box the colour that `color` makes of its place in the box and its colour so far.
template <class F>
void paint(RgbImage& image, const Box& box, F color) {
  for (int y = std::max(box.top, 0); y < std::min(box.top + box.rows, image.rows); ++y)
    for (int x = std::max(box.left, 0); x < std::min(box.left + box.cols, image.cols); ++x) {
      auto* pixel = &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.cols) +
                                    static_cast<std::size_t>(x))];
      const auto bytes = to_bytes(color(x - box.left, Color(Color(pixel[0], pixel[1], pixel[2]) / 255)));
      std::copy(bytes.begin(), bytes.end(), pixel);
    }
}

}  // namespace

void draw_legend(RgbImage& image, const ColorScale& scale) {
  const double text = std::max(0.014 * image.rows, 6.0);
  const int line = static_cast<int>(std::ceil(text));
  const int width = std::min(35 * line, image.cols - 10 * line);
  const Box panel{line, image.rows - 8 * line, width + 8 * line, 7 * line};
  const Box bar{panel.left + 4 * line, panel.top + 3 * line, width, line};
  const Color ink(0.12f, 0.13f, 0.15f);
  paint(image, panel, [](int, const Color& under) { return Color(0.25f * under + 0.75f * Color::Ones()); });
  paint(image, bar, [&](int x, const Color&) {
    return scale.at((static_cast<float>(x) + 0.5f) / static_cast<float>(bar.cols));
  });
  draw_text(image, scale.title(), bar.left, panel.top + line, text, ink);
  for (const float value : scale.ticks()) {
    const auto label = length_text(value);
    const double x = bar.left + scale.position(value) * bar.cols;
    draw_text(image, label, x - text_width(label, text) / 2, bar.top + 1.8 * line, text, ink);
  }
}

}  // namespace ppm
