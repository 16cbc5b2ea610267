#include "modules/maps/picture/stroke_text.hpp"

#include <map>
#include <string>

namespace ppm {
namespace {

// A glyph's strokes: points "xy" on a grid 4 wide, 6 down to the base line and 8 to the lowest descender; strokes apart
// by blanks.
const std::map<char, std::string_view>& glyphs() {
  static const std::map<char, std::string_view> strokes{
      {'0', "103041453616050110"},
      {'1', "112026"},
      {'2', "01103041420646"},
      {'3', "01103041423313334445361605"},
      {'4', "36300444"},
      {'5', "40000312324345361605"},
      {'6', "413010010516364544331304"},
      {'7', "004016"},
      {'8', "13020110304142331304051636454433"},
      {'9', "051636454130100102133342"},
      {'.', "2526"},
      {'-', "0444"},
      {'+', "0444 2226"},
      {'a', "4332120305163645 4246"},
      {'b', "0006 0312324345361605"},
      {'c', "4332120305163645"},
      {'d', "4046 4332120305163645"},
      {'e', "04444332120305163645"},
      {'f', "40302126 1242"},
      {'g', "4247381807 4332120305163645"},
      {'h', "0006 0312324346"},
      {'i', "2021 2226"},
      {'k', "0006 4204 1546"},
      {'l', "2026"},
      {'m', "0206 03122326 23324346"},
      {'n', "0206 0312324346"},
      {'o', "123243453616050312"},
      {'p', "0208 0312324345361605"},
      {'r', "0206 03123243"},
      {'s', "43321203143445361605"},
      {'t', "10152636 0232"},
      {'u', "0205163645 4246"},
      {'v', "022642"},
      {'w', "0216233642"},
      {'x', "0246 4206"},
      {'y', "0226 4208"},
      {'z', "02420646"}};
  return strokes;
}

constexpr double kAdvance = 6, kGridHeight = 6;

using Point = Eigen::Vector2d;

/// Blends a colour where a pixel is nearer to the segment than half the pen's width.
void draw_segment(RgbImage& image, const Point& a, const Point& b, double width, const Color& color) {
  const double reach = width / 2 + 1;
  const int x0 = std::max(static_cast<int>(std::min(a.x(), b.x()) - reach), 0);
  const int x1 = std::min(static_cast<int>(std::max(a.x(), b.x()) + reach), image.cols - 1);
  const int y0 = std::max(static_cast<int>(std::min(a.y(), b.y()) - reach), 0);
  const int y1 = std::min(static_cast<int>(std::max(a.y(), b.y()) + reach), image.rows - 1);
  const auto bytes = to_bytes(color);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const Point p(x, y), ab = b - a;
      const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      const double cover = std::clamp(width / 2 + 0.5 - (a + t * ab - p).norm(), 0.0, 1.0);
      auto* pixel = &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.cols) +
                                    static_cast<std::size_t>(x))];
      for (std::size_t k = 0; k < 3; ++k)
        pixel[k] = static_cast<std::uint8_t>(std::lround((1 - cover) * pixel[k] + cover * bytes[k]));
    }
}

void draw_glyph(RgbImage& image, std::string_view strokes, const Point& origin, double unit, double width,
                const Color& color) {
  auto at = [&](std::size_t k) { return Point(origin + unit * Point(strokes[k] - '0', strokes[k + 1] - '0')); };
  for (std::size_t k = 0; k + 4 <= strokes.size(); k += 2) {
    if (strokes[k + 2] == ' ') k += 3;  // the pen is lifted: on to the next stroke's first point
    draw_segment(image, at(k), at(k + 2), width, color);
  }
}

}  // namespace

double text_width(std::string_view text, double height_px) {
  return text.empty() ? 0 : (kAdvance * static_cast<double>(text.size()) - 2) * height_px / kGridHeight;
}

void draw_text(RgbImage& image, std::string_view text, double x, double y, double height_px, const Color& color) {
  const double unit = height_px / kGridHeight, width = std::max(1.2, 0.13 * height_px);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto glyph = glyphs().find(text[i]);
    if (glyph == glyphs().end()) continue;
    draw_glyph(image, glyph->second, {x + kAdvance * unit * static_cast<double>(i), y}, unit, width, color);
  }
}

}  // namespace ppm
