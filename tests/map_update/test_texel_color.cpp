#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/texel_color.hpp"
#include "tests/map_update/mapper.hpp"
#include "tests/map_update/views.hpp"
#include "tests/support/ppm_maps.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr double kSigma = 0.03;
const std::array<std::uint8_t, 3> kRed{204, 51, 51}, kBlue{51, 51, 153};

void paint(Frame& frame, const std::function<std::array<std::uint8_t, 3>(int, int)>& color) {
  frame.color.clear();
  for (int y = 0; y < frame.camera.rows; ++y)
    for (int x = 0; x < frame.camera.cols; ++x)
      for (auto c : color(x, y)) frame.color.push_back(c);
}

/// A plate across the optical axis at z = 2, seen head on: red where x < 0, blue beyond.
struct Plate {
  std::array<Eigen::Vector3f, 3> corner{Eigen::Vector3f(-0.5f, -0.4f, 2), Eigen::Vector3f(-0.5f, 0.5f, 2),
                                        Eigen::Vector3f(0.6f, -0.4f, 2)};
  static constexpr std::uint32_t kDivisions = 8;
  std::size_t count = texel_count(kDivisions);
  std::vector<float> mean = std::vector<float>(count, 0.0f), variance = std::vector<float>(count, 1e-4f),
                     color = std::vector<float>(3 * count, kColorPriorMean),
                     color_variance = std::vector<float>(count, kColorPriorVariance);

  void see(const std::function<float(int, int)>& depth, const ColorSettings& settings) {
    Frame frame = frame_of(depth);
    paint(frame, [](int x, int) { return x < 40 ? kRed : kBlue; });
    Prediction nothing;
    nothing.reset(small_camera(), 1, Pose::Identity(), 3);
    UpdateView view;
    view.build(frame, nothing, Workers(1));
    const ColorView colors(frame, view, std::vector<std::uint8_t>(frame.depth.size(), 0), 3, settings);
    gather_color(view, colors, {}, corner, kDivisions, 0, {mean, variance, color, color_variance});
  }
};

float wall(int, int) {
  return 2.0f;
}

}  // namespace

TEST_CASE("a plate of two colours, seen n times: every texel has the closed form's mean and variance") {
  const int n = GENERATE(1, 2, 7);
  Plate plate;
  for (int k = 0; k < n; ++k) plate.see(wall, {ColorExposure::fixed, 0});
  const double information = 12 + n / (kSigma * kSigma);
  std::size_t t = 0;
  int left = 0, right = 0;
  for (std::uint32_t i = 0; i <= Plate::kDivisions; ++i)
    for (std::uint32_t j = 0; i + j <= Plate::kDivisions; ++j, ++t) {
      CHECK(plate.color_variance[t] == Approx(1 / information).epsilon(1e-4));
      const double x = -0.5 + 1.1 * j / Plate::kDivisions, column = 70 * x / 2 + 39.5;
      if (std::abs(column - 39.5) < 1) continue;  // between the two
      const auto& seen = column < 39.5 ? kRed : kBlue;
      ++(column < 39.5 ? left : right);
      for (std::size_t c = 0; c < 3; ++c) {
        const double expected = (12 * 0.5 + n / (kSigma * kSigma) * seen[c] / 255) / information;
        CHECK(plate.color[3 * t + c] == Approx(expected).epsilon(1e-4));
      }
    }
  CHECK(left > 10);
  CHECK(right > 10);
}

TEST_CASE("with drift a texel's variance has a floor, where what an image adds is what time takes") {
  Plate plate;
  for (int k = 0; k < 200; ++k) plate.see(wall, {ColorExposure::fixed, 0.01f});
  const double q = 1e-4, s = kSigma * kSigma;
  const double floor = 0.5 * (-q + std::sqrt(q * q + 4 * q * s));
  for (float v : plate.color_variance) CHECK(v == Approx(floor).epsilon(1e-3));
}

TEST_CASE("what is measured beyond the gate, or not at all, gives no colour") {
  Plate plate;
  plate.see([](int, int) { return 2.3f; }, {});
  plate.see([](int, int) { return NAN; }, {});
  std::swap(plate.corner[1], plate.corner[2]);  // seen from behind
  plate.see(wall, {});
  for (float v : plate.color_variance) CHECK(v == kColorPriorVariance);
  for (float c : plate.color) CHECK(c == kColorPriorMean);
}

TEST_CASE("colours do not leak over a depth jump") {
  Plate plate;
  plate.see([](int x, int) { return x < 40 ? 2.0f : 2.6f; }, {ColorExposure::fixed, 0});
  for (std::size_t t = 0; t < plate.count; ++t)
    if (plate.color_variance[t] < kColorPriorVariance)
      CHECK(plate.color[3 * t] == Approx(kRed[0] / 255.0).epsilon(0.01));
}

TEST_CASE("a new face starts unseen and takes the image's colours") {
  Plate plate;
  std::fill(plate.color.begin(), plate.color.end(), 7.0f);
  Frame frame = frame_of([](int x, int) { return x < 40 ? 2.0f : NAN; });
  paint(frame, [](int, int) { return kRed; });
  Prediction nothing;
  nothing.reset(small_camera(), 1, Pose::Identity(), 3);
  UpdateView view;
  view.build(frame, nothing, Workers(1));
  const ColorView colors(frame, view, std::vector<std::uint8_t>(frame.depth.size(), 0), 3, {});
  start_color(view, colors, {}, plate.corner, Plate::kDivisions, 0,
              {plate.mean, plate.variance, plate.color, plate.color_variance});
  int unseen = 0;
  for (std::size_t t = 0; t < plate.count; ++t) {
    const bool seen = plate.color_variance[t] < kColorPriorVariance;
    unseen += !seen;
    CHECK(plate.color[3 * t] == Approx(seen ? kRed[0] / 255.0 : 0.5).epsilon(0.01));
  }
  CHECK((unseen > 5 && unseen < 40));
}

TEST_CASE("scatter: a pixel's colour goes to the texel that its ray hit") {
  PpmSettings settings;
  settings.color_channels = 1;
  PpmEdit make(std::make_shared<PpmMap>(settings));
  const Plate plate;
  std::array<std::uint32_t, 3> ids;
  for (std::size_t k = 0; k < 3; ++k) ids[k] = make.add_vertex(plate.corner[k]);
  const std::vector<float> zero(15, 0.0f), variance(15, 1e-4f), gray(15, 0.5f), prior(15, kColorPriorVariance);
  make.add_face(ids, 4, {zero, variance, gray, prior});
  PpmEdit edit(make.commit());
  Frame frame = frame_of(wall);
  paint(frame, [](int, int) { return std::array<std::uint8_t, 3>{255, 255, 255}; });
  Prediction seen;
  seen.reset(small_camera(), 1, Pose::Identity(), 1);
  const std::size_t pixel = 30 * 80 + 40;
  seen.range[pixel] = 2;
  seen.normal[3 * pixel + 2] = -1;
  seen.chunk[pixel] = seen.face[pixel] = 0;
  UpdateView view;
  view.build(frame, seen, Workers(1));
  std::vector<std::uint8_t> classes(frame.depth.size(), 0);
  classes[pixel] = kOwnHit;
  TexelSettings texels;
  texels.form = TexelForm::scatter;
  const ColorView colors(frame, view, classes, 1, {ColorExposure::fixed, 0});
  update_color(view, colors, classes, {{0, 0}}, texels, Workers(1), edit);
  const Texels& after = edit.texels(0);
  const double gain = kColorPriorVariance / (kColorPriorVariance + kSigma * kSigma);
  CHECK(after.color[0] == Approx(0.5 + gain * 0.5));  // the ray hit the first corner
  CHECK(after.color_variance[0] == Approx((1 - gain) * kColorPriorVariance));
  for (std::size_t t = 1; t < after.size(); ++t) CHECK(after.color_variance[t] == kColorPriorVariance);
}

TEST_CASE("a brighter image is divided by its gain over the map, channel by channel, unless the form is the paper's") {
  Frame frame = frame_of(wall);
  paint(frame, [](int, int) { return std::array<std::uint8_t, 3>{120, 90, 60}; });
  Prediction seen = prediction_of(wall);
  seen.reset(small_camera(), 1, Pose::Identity(), 3);
  const std::array<float, 3> expected{100 / 255.0f, 100 / 255.0f, 60 / 255.0f};
  for (std::size_t i = 0; i < seen.color.size(); ++i) seen.color[i] = expected[i % 3];
  UpdateView view;
  view.build(frame, seen, Workers(1));
  const std::vector<std::uint8_t> classes(frame.depth.size(), kOwnHit);
  const ColorView corrected(frame, view, classes, 3, {ColorExposure::gain, 0});
  CHECK(corrected.gain()[0] == Approx(1.2).epsilon(0.01));
  CHECK(corrected.gain()[1] == Approx(0.9).epsilon(0.01));
  CHECK(corrected.gain()[2] == Approx(1.0).epsilon(0.01));
  for (std::size_t c = 0; c < 3; ++c) CHECK(corrected.at(100)[c] == Approx(expected[c]).epsilon(0.01));
  const ColorView as_is(frame, view, classes, 3, {ColorExposure::fixed, 0});
  CHECK(as_is.at(100)[0] == Approx(120 / 255.0));
}

TEST_CASE("a map with colour cannot be updated with frames that have none") {
  const Frame frame = frame_of(wall);
  Prediction nothing;
  nothing.reset(small_camera(), 1, Pose::Identity(), 1);
  UpdateView view;
  view.build(frame, nothing, Workers(1));
  const std::vector<std::uint8_t> classes(frame.depth.size(), 0);
  CHECK_THROWS_WITH(ColorView(frame, view, classes, 1, {}), Catch::Contains("color: true"));
  CHECK(ColorView(frame, view, classes, 0, {}).empty());
}

namespace {

/// A room whose surfaces are painted in stripes along z, 40 cm wide.
Frame painted_frame(const BoxWorld& world, const Pose& pose, std::uint32_t index) {
  Frame frame = world.frame(small_camera(), pose, 0.004, index, true);
  for (int y = 0; y < frame.camera.rows; ++y)
    for (int x = 0; x < frame.camera.cols; ++x) {
      const double range = world.distance(pose.translation(), (pose.linear() * frame.camera.ray(x, y)).normalized());
      const double z = (pose.translation() + range * (pose.linear() * frame.camera.ray(x, y)).normalized()).z();
      const auto& color = static_cast<int>(std::floor(z / 0.4)) % 2 == 0 ? kRed : kBlue;
      frame.color.insert(frame.color.end(), color.begin(), color.end());
    }
  return frame;
}

std::shared_ptr<const PpmMap> map_of_painted_room(int channels, int threads) {
  BoxWorld world;
  PpmSettings settings;
  settings.color_channels = channels;
  Mapper mapper({}, settings, threads);
  for (int i = 0; i < 12; ++i)
    mapper.add(painted_frame(world, look({0.3, 0, 0.5}, 0.5 * i), static_cast<std::uint32_t>(i)));
  return mapper.handle();
}

}  // namespace

TEST_CASE("a painted room is predicted in its colours, intensity or RGB, the same with 1 and 2 threads") {
  const int channels = GENERATE(1, 3);
  const auto map = map_of_painted_room(channels, 1);
  CHECK(digest_of(*map) == digest_of(*map_of_painted_room(channels, 2)));
  CHECK(digest_of(*map) != digest_of(*map_of_painted_room(0, 1)));

  BoxWorld world;
  Mapper mapper(map);
  const Pose pose = look({0.2, 0.1, 0.6}, 0.7);
  const Frame frame = painted_frame(world, pose, 99);
  const Prediction seen = mapper.predict(frame.camera, pose);
  REQUIRE(seen.color.size() == seen.range.size() * static_cast<std::size_t>(channels));
  std::size_t right = 0, all = 0;
  for (std::size_t p = 0; p < seen.range.size(); ++p) {
    if (!seen.hit(p)) continue;
    const ColorValue truth = color_of(frame, p, channels);
    ++all;
    right += std::abs(seen.color[p * static_cast<std::size_t>(channels)] - truth[0]) < 0.05;
    CHECK(seen.color_variance[p] > 0);
  }
  CHECK(static_cast<double>(right) > 0.6 * static_cast<double>(all));  // all but near the stripes' edges
}
