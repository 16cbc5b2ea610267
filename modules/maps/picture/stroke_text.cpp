#include "modules/maps/picture/stroke_text.hpp"

#include <map>
#include <string>

#include "modules/maps/picture/stroke.hpp"

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
      {'_', "0747"},
      {'/', "4006"},
      {'a', "4332120305163645 4246"},
      {'b', "0006 0312324345361605"},
      {'c', "4332120305163645"},
      {'d', "4046 4332120305163645"},
      {'e', "04444332120305163645"},
      {'f', "40302126 1242"},
      {'g', "4247381807 4332120305163645"},
      {'h', "0006 0312324346"},
      {'i', "2021 2226"},
      {'j', "3031 32371807"},
      {'k', "0006 4204 1546"},
      {'l', "2026"},
      {'m', "0206 03122326 23324346"},
      {'n', "0206 0312324346"},
      {'o', "123243453616050312"},
      {'p', "0208 0312324345361605"},
      {'q', "4248 4332120305163645"},
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

void draw_glyph(RgbImage& image, std::string_view strokes, const Point& origin, double unit, double width,
                const Color& color) {
  auto at = [&](std::size_t k) { return Point(origin + unit * Point(strokes[k] - '0', strokes[k + 1] - '0')); };
  for (std::size_t k = 0; k + 4 <= strokes.size(); k += 2) {
    if (strokes[k + 2] == ' ') k += 3;  // the pen is lifted: on to the next stroke's first point
    draw_stroke(image, at(k), at(k + 2), width, color);
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
