#include <catch2/catch.hpp>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/face_votes.hpp"
#include "tests/support/ppm_maps.hpp"

using namespace ppm;

namespace {

constexpr FaceRef kFace{0, 0};

std::shared_ptr<const PpmMap> one_face() {
  PpmEdit edit(std::make_shared<const PpmMap>(PpmSettings{}));
  const std::vector<float> mean(3, 0.0f), variance(3, 1e-6f);
  const auto a = edit.add_vertex({0, 0, 1}), b = edit.add_vertex({0, 0.1f, 1}), c = edit.add_vertex({0.1f, 0, 1});
  edit.add_face({a, b, c}, 1, {mean, variance});
  return edit.commit();
}

/// Feeds a face frames of `pixels` residuals drawn with that standard deviation, of which `accounted` (m^2) is
/// predicted beside the excess; returns its excess.
float excess_after(int frames, int pixels, double sigma, float accounted, const ExcessSettings& settings) {
  Rng rng(3, 0, 0, 0);
  auto map = one_face();
  for (int i = 0; i < frames; ++i) {
    PpmEdit edit(std::move(map));
    FaceTally tally{kFace, pixels};
    const float added = edit.map().table()[0].texels->evidence[0].added_variance();
    for (int p = 0; p < pixels; ++p) {
      const auto off = static_cast<float>(sigma * rng.normal());
      tally.surplus += off * off - accounted - added;
    }
    learn_excess({tally}, settings, edit);
    cast_votes({tally}, {}, edit);
    map = edit.commit();
  }
  return map->table()[0].texels->evidence[0].excess;
}

}  // namespace

TEST_CASE("a face learns the variance that nothing else accounts for") {
  ExcessSettings settings;
  settings.least_views = 2;
  CHECK(excess_after(400, 50, 0.01, 2.5e-5f, settings) == Approx(7.5e-5).epsilon(0.05));
  CHECK(excess_after(400, 50, 0.01, 1e-4f, settings) == Approx(0).margin(2e-6));
}

TEST_CASE("less scatter than predicted is learnt too, and takes nothing from the texels' variance") {
  ExcessSettings settings;
  settings.least_views = 2;
  const float excess = excess_after(400, 50, 0.005, 1e-4f, settings);
  CHECK(excess < -6e-5f);
  FaceEvidence e;
  e.excess = excess;
  CHECK(e.added_variance() == 0);
}

TEST_CASE("a young face keeps what it started with, and so does every face in the paper's form") {
  ExcessSettings settings;
  settings.least_views = 25;
  CHECK(excess_after(24, 50, 0.01, 0, settings) == 0);
  CHECK(excess_after(30, 50, 0.01, 0, settings) > 0);
  settings.learn = false;
  CHECK(excess_after(100, 50, 0.01, 0, settings) == 0);
}

TEST_CASE("new faces start with the mean excess over the hits in view, or with the prior in an empty view") {
  ExcessSettings settings;
  PpmEdit edit(one_face());
  edit.texels(0).evidence[0] = {60000, 0, 4e-4f};
  CHECK(learn_excess({}, settings, edit) == Approx(settings.prior_sigma * settings.prior_sigma));
  const float mixed = learn_excess({{kFace, 900, 0, 0.0f}}, settings, edit);
  CHECK(mixed == Approx((900 * 4e-4 + 100 * settings.prior_sigma * settings.prior_sigma) / 1000).epsilon(0.01));
}

namespace {

/// Frames of 20 pixels that see through a face with 5000 hits until it is lost.
int frames_until_lost(bool deserted) {
  PpmEdit edit(one_face());
  edit.texels(0).evidence[0].hits = 5000;
  FaceTally through{kFace, 0, 20};
  through.deserted = deserted;
  int frames = 1;
  while (cast_votes({through}, {}, edit).empty()) ++frames;
  return frames;
}

}  // namespace

TEST_CASE("a face that stood for long goes soon when it is deserted, and outlives many passing edges") {
  CHECK(frames_until_lost(true) < 30);
  CHECK(frames_until_lost(false) > 170);
}
