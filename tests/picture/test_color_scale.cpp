#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "modules/maps/picture/legend.hpp"
#include "modules/maps/picture/stroke_text.hpp"
#include "tests/support/box_room.hpp"

using namespace ppm;

namespace {

Mesh mesh_of(const std::vector<float>& sigma, const std::vector<float>& mean) {
  Mesh mesh;
  mesh.position.resize(sigma.size());
  mesh.mean = mean;
  for (const float s : sigma) mesh.variance.push_back(s * s);
  return mesh;
}

RgbImage white(int cols, int rows) {
  RgbImage image{cols, rows, {}};
  image.rgb.assign(3 * static_cast<std::size_t>(cols * rows), 255);
  return image;
}

std::size_t dark_pixels(const RgbImage& image) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) count += image.rgb[i] < 100;
  return count;
}

}  // namespace

TEST_CASE("the scale of sigma is logarithmic, from the range on") {
  const ColorScale scale(Show::sigma, {1e-3f, 1e-1f});
  CHECK(scale.position(1e-3f) == 0);
  CHECK(scale.position(1e-2f) == Approx(0.5));
  CHECK(scale.position(1e-1f) == Approx(1));
  CHECK(scale.color(1e-6f) == scale.at(0));
  CHECK(scale.color(1) == scale.at(1));
  const std::vector<float> ticks = scale.ticks();
  REQUIRE(ticks.size() == 7);
  for (std::size_t k = 0; k < 7; ++k)
    CHECK(ticks[k] == Approx(std::vector<double>{1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 1e-1}[k]));
}

TEST_CASE("lightness grows along the scale of sigma, and zero is grey in that of the mean") {
  const ColorScale sigma(Show::sigma, {1e-3f, 1e-1f}), mean(Show::mean, {-0.1f, 0.1f});
  auto lightness = [](const Color& c) { return 0.21f * c.x() + 0.72f * c.y() + 0.07f * c.z(); };
  for (int k = 0; k < 20; ++k)
    CHECK(lightness(sigma.at(static_cast<float>(k) / 20)) < lightness(sigma.at(static_cast<float>(k + 1) / 20)));
  const Color zero = mean.color(0);
  CHECK(zero.maxCoeff() - zero.minCoeff() < 0.01f);
  CHECK(mean.color(-0.1f).z() > mean.color(-0.1f).x());
  CHECK(mean.color(0.1f).x() > mean.color(0.1f).z());
  CHECK(mean.ticks().size() == 5);
}

TEST_CASE("a mesh's range leaves outliers out and is rounded to 1, 2, 5") {
  std::vector<float> sigma(1000, 3e-3f), mean(1000, 0.0f);
  for (std::size_t k = 0; k < 100; ++k) sigma[k] = 1.5e-2f;
  sigma[500] = 7;
  for (std::size_t k = 0; k < 100; ++k) mean[k] = -0.034f;
  const Mesh mesh = mesh_of(sigma, mean);
  CHECK(scale_range(mesh, Show::sigma).low == Approx(2e-3));
  CHECK(scale_range(mesh, Show::sigma).high == Approx(2e-2));
  CHECK(scale_range(mesh, Show::mean).low == Approx(-0.05));
  CHECK(scale_range(mesh, Show::mean).high == Approx(0.05));
  CHECK(scale_range({}, Show::sigma).low > 0);
  const Mesh flat = mesh_of({1e-3f, 1e-3f}, {0, 0});
  CHECK_NOTHROW(ColorScale(Show::sigma, scale_range(flat, Show::sigma)));
  CHECK_NOTHROW(ColorScale(Show::mean, scale_range(flat, Show::mean)));
  CHECK_THROWS_AS(ColorScale(Show::sigma, {0, 1}), InternalError);
}

TEST_CASE("lengths are written with the unit that suits them") {
  CHECK(length_text(0) == "0");
  CHECK(length_text(2e-4f) == "0.2 mm");
  CHECK(length_text(5e-5f) == "50 um");
  CHECK(length_text(5e-3f) == "5 mm");
  CHECK(length_text(1e-2f) == "1 cm");
  CHECK(length_text(-2.5e-2f) == "-2.5 cm");
  CHECK(length_text(2) == "2 m");
}

TEST_CASE("vertex colours follow what is shown") {
  const Mesh room = test::box_room(1, 1, 1);
  CHECK(vertex_colors(room, Show::shaded, {}).empty());
  CHECK(vertex_colors(room, Show::color, {}).empty());
  CHECK(vertex_colors(room, Show::normal, {})[0] == normal_color(room.normal[0]));
  const auto scale = scale_for(room, Show::sigma, ScaleRange{1e-3f, 1e-1f});
  CHECK(vertex_colors(room, Show::sigma, scale)[0] == scale->color(0.01f));
  CHECK_FALSE(scale_for(room, Show::normal, {}));
}

TEST_CASE("text is drawn where it is said, as wide as it is said") {
  RgbImage image = white(120, 30);
  draw_text(image, "0.2 mm", 5, 8, 12, Color::Zero());
  CHECK(dark_pixels(image) > 60);
  const int right = static_cast<int>(5 + text_width("0.2 mm", 12) + 2);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      if (x < 3 || x > right || y < 6 || y > 22)
        CHECK(image.rgb[3 * static_cast<std::size_t>(y * image.cols + x)] == 255);
  RgbImage off = white(20, 20);
  draw_text(off, "88888", -10, -3, 12, Color::Zero());  // what is outside is left out
  draw_text(off, "88888", 15, 15, 12, Color::Zero());
  CHECK(dark_pixels(off) > 0);
}

TEST_CASE("a legend fits into small and large pictures") {
  for (const int rows : {16, 48, 960}) {
    RgbImage image = white(rows * 4 / 3, rows);
    draw_legend(image, ColorScale(Show::sigma, {1e-3f, 1e-1f}));
    CHECK(image.rgb != white(rows * 4 / 3, rows).rgb);
  }
}

TEST_CASE("a scale of another length is linear from its low end to its high one") {
  const ColorScale scale("error", {0, 0.05f});
  CHECK(scale.title() == "error");
  CHECK_FALSE(scale.logarithmic());
  CHECK(scale.position(0.0125f) == Approx(0.25));
  CHECK(scale.color(1) == scale.at(1));
  CHECK(scale.color(-1) == scale.at(0));
  const auto ticks = scale.ticks();
  REQUIRE(ticks.size() == 6);
  CHECK(ticks[0] == 0);
  CHECK(ticks[5] == Approx(0.05));
  CHECK_THROWS_AS(ColorScale("error", ScaleRange{1, 1}), InternalError);
}
