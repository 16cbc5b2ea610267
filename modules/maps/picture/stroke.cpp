#include "modules/maps/picture/stroke.hpp"

namespace ppm {

void draw_stroke(RgbImage& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width_px,
                 const Color& color) {
  using Point = Eigen::Vector2d;
  const double reach = width_px / 2 + 1;
  const int x0 = std::max(static_cast<int>(std::min(a.x(), b.x()) - reach), 0);
  const int x1 = std::min(static_cast<int>(std::max(a.x(), b.x()) + reach), image.cols - 1);
  const int y0 = std::max(static_cast<int>(std::min(a.y(), b.y()) - reach), 0);
  const int y1 = std::min(static_cast<int>(std::max(a.y(), b.y()) + reach), image.rows - 1);
  const auto bytes = to_bytes(color);
  const Point ab = b - a;
  const double length2 = ab.squaredNorm();
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const Point p(x, y);
      const double t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
      const double cover = std::clamp(width_px / 2 + 0.5 - (a + t * ab - p).norm(), 0.0, 1.0);
      auto* pixel = &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.cols) +
                                    static_cast<std::size_t>(x))];
      for (std::size_t k = 0; k < 3; ++k)
        pixel[k] = static_cast<std::uint8_t>(std::lround((1 - cover) * pixel[k] + cover * bytes[k]));
    }
}

}  // namespace ppm
