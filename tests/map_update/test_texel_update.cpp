#include <catch2/catch.hpp>
#include <cmath>

#include "modules/maps/ppm/texel_update.hpp"
#include "tests/map_update/views.hpp"
#include "tests/support/ppm_maps.hpp"
#include "tests/support/workers.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr float kPrior = 0.0025f;

/// One large face across the optical axis at z = 2, seen head on, 8 divisions.
struct Wall {
  std::array<Eigen::Vector3f, 3> corner{Eigen::Vector3f(-0.5f, -0.4f, 2), Eigen::Vector3f(-0.5f, 0.5f, 2),
                                        Eigen::Vector3f(0.6f, -0.4f, 2)};
  std::uint32_t divisions = 8;
  std::vector<float> mean = std::vector<float>(texel_count(8), 0.0f),
                     variance = std::vector<float>(texel_count(8), kPrior);

  void gather(const std::function<float(int, int)>& depth) {
    const Frame frame = frame_of(depth);
    TexelSettings settings;
    const Prediction nothing = prediction_of([](int, int) { return NAN; });
    UpdateView view;
    view.build(frame, nothing, test::one_worker());
    view.lateral_px = 0;  // so that nearly head on the variance is the depth's
    gather_face(view, settings, corner, divisions, 0, mean, variance);
  }
};

}  // namespace

TEST_CASE("fusing is the product of two Gaussians") {
  float mean = 0.01f, variance = 4e-4f;
  fuse(mean, variance, 0.03f, 1e-4f);
  CHECK(mean == Approx((0.01 / 4e-4 + 0.03 / 1e-4) / (1 / 4e-4 + 1 / 1e-4)));
  CHECK(variance == Approx(1 / (1 / 4e-4 + 1 / 1e-4)));
}

TEST_CASE("the order of measurements does not matter, and n equal ones give the prior's pull and 1/n of the variance") {
  float m1 = 0, v1 = kPrior, m2 = 0, v2 = kPrior;
  for (float z : {0.01f, 0.02f, 0.03f}) fuse(m1, v1, z, 1e-4f);
  for (float z : {0.03f, 0.01f, 0.02f}) fuse(m2, v2, z, 1e-4f);
  CHECK(m1 == Approx(m2));
  CHECK(m1 == Approx(0.02 * (3 / 1e-4) / (3 / 1e-4 + 1 / 0.0025)));
  CHECK(v1 == Approx(1 / (3 / 1e-4 + 1 / 0.0025)));
  CHECK(v1 == Approx(v2));
}

TEST_CASE("variance along the normal: that of the depth head on, that of the direction at grazing angles") {
  CHECK(variance_along_normal(0.01f, 1, 0.003f) == Approx(1e-4));
  CHECK(variance_along_normal(0.01f, 0, 0.003f) == Approx(9e-6));
  CHECK(variance_along_normal(0.01f, 0.6f, 0.003f) == Approx(0.36e-4 + 0.64 * 9e-6));
}

TEST_CASE("gather: texels take the measured offset, signed towards the camera, with the closed-form posterior") {
  Wall wall;
  wall.gather([](int, int) { return 1.985f; });
  // A pixel's footprint at 2 m is (2/70 m)^2 = 8.2e-4 m^2, a texel's area 2 * 0.495 / 64 m^2 is larger: no dilution.
  for (std::size_t t = 0; t < wall.mean.size(); ++t) {
    const double s2 = 0.004 * 0.004;  // head on but for a few degrees
    CHECK(wall.mean[t] == Approx(0.015 * kPrior / (kPrior + s2)).margin(2e-4));
    CHECK(wall.variance[t] == Approx(kPrior * s2 / (kPrior + s2)).epsilon(0.2));
  }
}

TEST_CASE("gather: a measurement beyond the gate, none, or a face seen from behind changes nothing") {
  Wall wall;
  const auto before = wall.variance;
  wall.gather([](int, int) { return 2.2f; });
  wall.gather([](int, int) { return NAN; });
  std::swap(wall.corner[1], wall.corner[2]);
  wall.gather([](int, int) { return 2.0f; });
  CHECK(wall.variance == before);
}

TEST_CASE("gather: a depth jump does not leak into the texels beside it") {
  Wall wall;
  wall.gather([](int x, int) { return x < 40 ? 1.99f : 2.6f; });
  for (float m : wall.mean) CHECK((m == 0.0f || m == Approx(0.01).margin(5e-4)));
}

TEST_CASE("gather: texels finer than pixels take less from each: their information together is the pixels'") {
  Wall coarse, fine;
  fine.divisions = 48;
  fine.mean.assign(texel_count(48), 0.0f);
  fine.variance.assign(texel_count(48), kPrior);
  coarse.gather([](int, int) { return 2.0f; });
  fine.gather([](int, int) { return 2.0f; });
  const auto middle = texel_index(48, 16, 16);
  const double information = 1 / fine.variance[middle] - 1 / kPrior;
  const double area = 2 * 0.495 / (48 * 48), pixel = (2.0 / 70) * (2.0 / 70);
  CHECK(information == Approx(area / pixel / (0.004 * 0.004)).epsilon(0.1));
}

TEST_CASE("scatter: each own hit updates the texel nearest to it, like the closed form") {
  // One face across the view at z = 2; the prediction says that pixel (40, 30) hit it at its corner.
  PpmEdit make(std::make_shared<PpmMap>(PpmSettings{}));
  const Wall wall;
  const auto a = make.add_vertex(wall.corner[0]), b = make.add_vertex(wall.corner[1]),
             c = make.add_vertex(wall.corner[2]);
  add_flat_face(make, {a, b, c}, 4, 0, kPrior);
  PpmEdit edit(make.commit());
  const Frame frame = frame_of([](int, int) { return 1.99f; });
  Prediction seen = prediction_of([](int x, int y) { return x == 40 && y == 30 ? 2.0f : NAN; }, kPrior);
  UpdateView view;
  view.build(frame, seen, test::one_worker());
  view.lateral_px = 0;
  std::vector<std::uint8_t> classes(frame.depth.size(), 0);
  classes[30 * 80 + 40] = kOwnHit;
  TexelSettings settings;
  settings.form = TexelForm::scatter;
  update_texels(view, classes, {{0, 0}}, settings, test::one_worker(), edit);
  const Texels& texels = edit.texels(0);
  const double s2 = 0.004 * 0.004;
  int updated = 0;
  for (std::size_t t = 0; t < texels.mean.size(); ++t) {
    if (texels.variance[t] == kPrior) continue;
    ++updated;
    CHECK(texels.mean[t] == Approx(0.01 * kPrior / (kPrior + s2)).epsilon(0.01));
    CHECK(texels.variance[t] == Approx(kPrior * s2 / (kPrior + s2)).epsilon(0.01));
  }
  CHECK(updated == 1);
}

TEST_CASE("new texels in the paper's form: zero mean and the sensor's variance, the prior's without a measurement") {
  Wall wall;
  TexelSettings settings;
  settings.new_texels = NewTexels::sensor;
  const Prediction nothing = prediction_of([](int, int) { return NAN; });
  for (const bool measured : {true, false}) {
    const Frame frame = frame_of([measured](int, int) { return measured ? 1.99f : NAN; });
    UpdateView view;
    view.build(frame, nothing, test::one_worker());
    view.lateral_px = 0;
    start_texels(view, settings, wall.corner, wall.divisions, kPrior, 0, wall.mean, wall.variance);
    for (float m : wall.mean) CHECK(m == 0);
    for (float v : wall.variance) CHECK(v == Approx(measured ? 0.004 * 0.004 : kPrior).epsilon(0.05));
  }
}
