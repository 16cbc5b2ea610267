#include "modules/maps/picture/view_picture.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "framework/core/error.hpp"
#include "framework/core/timing.hpp"
#include "framework/slam/surface_view.hpp"
#include "modules/maps/picture/legend.hpp"
#include "modules/maps/picture/stroke_text.hpp"

namespace ppm {
namespace {

constexpr int kLeastCols = 640;
const Color kUnmeasured(0.16f, 0.16f, 0.18f), kPaper(0.97f, 0.97f, 0.97f), kInk(0.12f, 0.13f, 0.15f);

/// What a pixel of the image looks like.
struct Look {
  Color color;
  bool hatched = false;
};

/// Rows below the image for a legend, which is sized by the rows of the whole.
int foot_rows(int image_rows) {
  return std::max(image_rows / 6, 64);
}

Color hatching(int x, int y) {
  return (x + y) / 6 % 2 == 0 ? Color(0.10f, 0.10f, 0.11f) : Color(0.36f, 0.36f, 0.38f);
}

/// look(pixel) of each pixel of the camera's image, enlarged, over an empty foot.
template <class F>
RgbImage enlarged(const Camera& camera, F look) {
  const int zoom = std::max((kLeastCols + camera.cols - 1) / camera.cols, 1);
  RgbImage image{zoom * camera.cols, zoom * camera.rows + foot_rows(zoom * camera.rows), {}};
  image.rgb.reserve(3 * static_cast<std::size_t>(image.cols) * static_cast<std::size_t>(image.rows));
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const bool foot = y >= zoom * camera.rows;
      const Look seen = foot ? Look{kPaper} : look(static_cast<std::size_t>(y / zoom * camera.cols + x / zoom));
      const auto bytes = to_bytes(seen.hatched ? hatching(x, y) : seen.color);
      image.rgb.insert(image.rgb.end(), bytes.begin(), bytes.end());
    }
  return image;
}

void caption(RgbImage& image, std::string_view text) {
  const double height = 0.018 * image.rows;
  draw_text(image, text, 2 * height, image.rows - 2 * height, height, kInk);
}

/// By a large light a little above and to the left of the camera, which reaches round to what is turned away by 110 degrees.
/// normal: camera frame.
Color lit(const Camera& camera, const Eigen::Vector3f& normal) {
  const float up = camera.fy > 0 ? -0.5f : 0.5f;  // image rows grow downwards
  const float cosine = normal.dot(Eigen::Vector3f(-0.4f, up, -1).normalized());
  const float light = std::max(cosine + 0.35f, 0.0f) / 1.35f;
  return (0.12f + 0.88f * light) * Color(0.96f, 0.94f, 0.90f);
}

}  // namespace

RgbImage depth_picture(const Frame& frame, const ColorScale& scale) {
  auto image = enlarged(frame.camera, [&](std::size_t i) {
    return Look{frame.valid(static_cast<int>(i)) ? scale.color(frame.depth[i]) : kUnmeasured};
  });
  draw_legend(image, scale);
  return image;
}

RgbImage prediction_picture(const Prediction& view) {
  SurfaceView surface;
  surface.build(view);
  auto image = enlarged(view.camera, [&](std::size_t i) {
    const auto& texel = surface.texels[i];
    return view.hit(i) ? Look{lit(view.camera, {texel.nx, texel.ny, texel.nz})} : Look{kUnmeasured, true};
  });
  caption(image, "predicted surface - hatched where nothing is predicted");
  return image;
}

RgbImage error_picture(const Frame& frame, const Prediction& view, const ColorScale& scale) {
  PPM_CHECK(view.camera == frame.camera, "a prediction for another camera");
  auto image = enlarged(frame.camera, [&](std::size_t i) {
    const int pixel = static_cast<int>(i);
    if (!frame.valid(pixel)) return Look{kUnmeasured};
    if (!view.hit(i)) return Look{kUnmeasured, true};
    const double range_per_depth = frame.camera.ray(pixel % frame.camera.cols, pixel / frame.camera.cols).norm();
    const double off = frame.depth[i] * range_per_depth - view.expected_range(i, view.direction(i));
    return Look{scale.color(static_cast<float>(std::abs(off)))};
  });
  draw_legend(image, scale);
  return image;
}

ColorScale depth_scale(const Frame& frame) {
  std::vector<double> depths;
  for (float z : frame.depth)
    if (z == z) depths.push_back(z);
  if (depths.empty()) depths = {0};
  const auto low = static_cast<float>(quantile(depths, 0.01)), high = static_cast<float>(quantile(depths, 0.99));
  return {"measured depth", {low, std::max(high, low + 0.1f)}};
}

ColorScale error_scale() {
  return {"error along the ray", {0, 0.05f}};
}

}  // namespace ppm
