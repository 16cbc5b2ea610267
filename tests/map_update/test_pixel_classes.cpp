#include <catch2/catch.hpp>
#include <cmath>

#include "modules/maps/ppm/face_votes.hpp"
#include "modules/maps/ppm/pixel_classes.hpp"
#include "modules/maps/ppm/triangle_test.hpp"
#include "tests/map_update/views.hpp"
#include "tests/support/workers.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

std::vector<std::uint8_t> classes_of(const std::function<float(int, int)>& measured,
                                     const std::function<float(int, int)>& predicted,
                                     const std::vector<std::uint8_t>& gone = {}) {
  const Frame frame = frame_of(measured);
  const Prediction seen = prediction_of(predicted);
  UpdateView view;
  view.build(frame, seen, test::one_worker());
  std::vector<std::uint8_t> classes;
  classify_pixels(view, SurfaceGate{}, 4, gone, test::one_worker(), classes);
  return classes;
}

constexpr auto wall = [](int, int) { return 2.0f; };
constexpr auto nothing = [](int, int) { return NAN; };
const Eigen::Vector3f kBack(0, 0, -1);
const std::array<Eigen::Vector3f, 3> kFacing{kBack, kBack, kBack};
constexpr std::size_t kMiddle = 30 * 80 + 40;

}  // namespace

TEST_CASE("a pixel within the gate is an own hit, in front of it, something new, behind it, seen through") {
  // One spread is sqrt(0.004^2 + 0.008^2) = 8.9 mm; the gate is at 36 mm.
  CHECK(classes_of([](int, int) { return 1.967f; }, wall)[kMiddle] == (kOwnHit | kExplained));
  CHECK(classes_of([](int, int) { return 2.033f; }, wall)[kMiddle] == (kOwnHit | kExplained));
  CHECK(classes_of([](int, int) { return 1.96f; }, wall)[kMiddle] == (kInFront | kWanted));
  CHECK(classes_of([](int, int) { return 2.04f; }, wall)[kMiddle] == kBehind);
  CHECK(classes_of(wall, nothing)[kMiddle] == kWanted);
  CHECK(classes_of(nothing, wall)[kMiddle] == 0);
}

TEST_CASE("a miss beside a surface that would explain it is explained, but no own hit") {
  const auto hole = [](int x, int y) { return x == 40 && y == 30 ? NAN : 2.0f; };
  CHECK(classes_of(wall, hole)[kMiddle] == kExplained);
  const auto wide_hole = [](int x, int y) { return std::abs(x - 40) < 3 && std::abs(y - 30) < 3 ? NAN : 2.0f; };
  CHECK(classes_of(wall, wide_hole)[kMiddle] == kWanted);
}

TEST_CASE("pixels of deleted faces count as misses, also for their neighbours") {
  const std::vector<std::uint8_t> gone(80 * 60, 1);
  CHECK(classes_of(wall, wall, gone)[kMiddle] == kWanted);
}

TEST_CASE("opening removes what is thinner than 2 r + 1 pixels, but for what the image's edge or missing pixels cut") {
  const int cols = 12, rows = 9;
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * cols + x); };
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(cols * rows), 0), ignored = mask;
  for (int y = 0; y < rows; ++y) {
    mask[at(0, y)] = mask[at(1, y)] = 1;   // two columns at the left edge: the rest of them may lie beyond it
    mask[at(5, y)] = mask[at(6, y)] = 1;   // two columns inside: too thin
    mask[at(9, y)] = mask[at(10, y)] = 1;  // two columns and an unmeasured one
    ignored[at(8, y)] = 1;
  }
  open_mask(cols, rows, 1, ignored, mask);
  CHECK(mask[at(0, 4)] == 1);
  CHECK(mask[at(5, 4)] == 0);
  CHECK(mask[at(9, 4)] == 1);
  CHECK(mask[at(8, 4)] == 0);
}

TEST_CASE("a triangle is surface where the measurement lies on it") {
  const Frame frame = frame_of(wall);
  const Prediction none = prediction_of(nothing);
  UpdateView view;
  view.build(frame, none, test::one_worker());
  std::vector<std::uint8_t> classes(frame.depth.size(), kWanted);
  const std::array<Eigen::Vector2f, 3> pixel{Eigen::Vector2f(30, 20), Eigen::Vector2f(30, 30), Eigen::Vector2f(42, 20)};
  const auto corner = [&](float z0, float z1, float z2) {
    return std::array<Eigen::Vector3f, 3>{view.ray(30, 20) * z0, view.ray(30, 30) * z1, view.ray(42, 20) * z2};
  };
  CHECK(is_surface(view, classes, {}, corner(2, 2, 2), kFacing, pixel));
  CHECK_FALSE(is_surface(view, classes, {}, corner(1.9f, 1.9f, 1.9f), kFacing, pixel));  // floats in front
  CHECK_FALSE(is_surface(view, classes, {}, corner(2, 2, 1.2f), kFacing, pixel));        // spans a jump

  std::fill(classes.begin(), classes.end(), std::uint8_t{kOwnHit | kExplained});
  CHECK_FALSE(is_surface(view, classes, {}, corner(2, 2, 2), kFacing, pixel));  // the map has it already
}

TEST_CASE("a triangle through flying pixels is refused, though the measurement lies on it") {
  // Pixels that mix a near and a far surface: a ramp of 1 m over three pixels.
  const Frame frame = frame_of([](int x, int) {
    return x < 39 ? 1.0f : x > 42 ? 2.0f : 1.0f + 0.25f * static_cast<float>(x - 38);
  });
  const Prediction none = prediction_of(nothing);
  UpdateView view;
  view.build(frame, none, test::one_worker());
  const std::vector<std::uint8_t> classes(frame.depth.size(), kWanted);
  const std::array<Eigen::Vector2f, 3> pixel{Eigen::Vector2f(38, 20), Eigen::Vector2f(38, 24), Eigen::Vector2f(42, 20)};
  const std::array<Eigen::Vector3f, 3> corner{view.ray(38, 20) * 1.0f, view.ray(38, 24) * 1.0f,
                                              view.ray(42, 20) * 2.0f};
  CHECK_FALSE(is_surface(view, classes, {}, corner, kFacing, pixel));
}

TEST_CASE("a steep triangle is surface where the surfaces at its corners are as steep, a bridge where they are not") {
  // A floor seen at a cosine of 0.2: y = 0.4 below the camera, about 2 m away.
  const Camera camera = small_camera();
  const Frame frame =
      frame_of([&](int, int y) { return y > 31 ? 0.4f / static_cast<float>(camera.ray(0, y).y()) : NAN; });
  const Prediction none = prediction_of(nothing);
  UpdateView view;
  view.build(frame, none, test::one_worker());
  const std::vector<std::uint8_t> classes(frame.depth.size(), kWanted);
  const std::array<Eigen::Vector2f, 3> pixel{Eigen::Vector2f(40, 42), Eigen::Vector2f(34, 46), Eigen::Vector2f(46, 46)};
  std::array<Eigen::Vector3f, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3f ray = view.ray(pixel[k].x(), pixel[k].y());
    corner[k] = ray * (0.4f / ray.y());
  }
  const Eigen::Vector3f up(0, -1, 0);
  TriangleSettings settings;
  settings.cosine_least = 0.15f;
  CHECK((corner[1] - corner[0]).cross(corner[2] - corner[0]).y() < 0);
  CHECK(is_surface(view, classes, settings, corner, {up, up, up}, pixel));
  CHECK_FALSE(is_surface(view, classes, settings, corner, kFacing, pixel));
  CHECK_FALSE(is_surface(view, classes, {}, corner, {up, up, up}, pixel));  // too steep for frames that are not grazing
}
