#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <memory>
#include <numeric>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/chunk.hpp"
#include "modules/prediction/raster_camera.hpp"
#include "modules/prediction/raster_lookup.hpp"

using namespace ppm;

namespace {

/// A face of one chunk that lies across the optical axis at 1 m, with three texels alike.
struct OneFace {
  std::uint8_t divisions = 1;
  std::uint32_t first_texel = 0;
  FaceEvidence evidence;
  std::unique_ptr<float[]> texels;  // means, then variances

  OneFace(std::size_t room, float mean, float variance) : texels(new float[room]) {
    std::fill_n(texels.get(), 3, mean);
    std::fill_n(texels.get() + 3, 3, variance);
  }
  RasterTexels as_chunk(std::uint32_t number) const {
    return {number, &divisions, &first_texel, &evidence, texels.get(), texels.get() + 3};
  }
};

void add_triangle(RasterBand& band, std::uint32_t slot) {
  const float quads[4][4] = {{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 1, 0}, {0, 0, 1, std::bit_cast<float>(slot)}};
  for (int k = 0; k < 4; ++k) {
    band.quad[k].reserve(4 * (band.triangles + 1 + RasterBand::kSpare), 4 * band.triangles);
    std::copy_n(quads[k], 4, band.quad[k].data() + 4 * band.triangles);
  }
  ++band.triangles;
}

}  // namespace

TEST_CASE("texels of chunks that lie far apart in memory are found, and misses between them") {
  const Camera camera{300, 2, 100, 100, 150, 1};
  const OneFace near(6, 0.25f, 0.5f), far(std::size_t{1} << 26, 0.75f, 2.f);  // so large that it gets pages of its own
  RasterBand band;
  band.end_row = camera.rows;
  band.texels = {near.as_chunk(0), far.as_chunk(1)};
  add_triangle(band, 0);
  add_triangle(band, 1);
  const auto pixels = static_cast<std::size_t>(camera.pixels());
  band.shown.reserve(pixels + RasterBand::kSpare);
  for (std::size_t p = 0; p < pixels; ++p) band.shown.data()[p] = p % 7 == 0 ? RasterBand::kNone : p / 5 % 2;

  std::vector<std::uint32_t> asked(pixels);
  std::iota(asked.begin(), asked.end(), 0u);
  const RasterQuestion question{.linear_texels = true, .along_ray = false, .least_cosine = 0.2f, .miss = 99};
  RasterLookup lookup(raster_camera(camera, Pose::Identity(), true), question);
  std::size_t done = 0, wrong = 0;
  for (std::span<const std::uint32_t> rest = asked; !rest.empty(); rest = rest.subspan(lookup.at.size)) {
    REQUIRE(lookup.find(band, rest) > 0);
    for (std::size_t i = 0; i < lookup.at.size; ++i, ++done) {
      const RasterTexels* texels = lookup.face(i).texels;
      const bool miss = done % 7 == 0, second = done / 5 % 2;
      if (miss)
        wrong += texels != nullptr;
      else
        wrong += !texels || texels->chunk != second || lookup.at.mean[i] != (second ? 0.75f : 0.25f) ||
                 lookup.at.variance[i] != (second ? 2.f : 0.5f) || lookup.at.range[i] < 1;
    }
  }
  CHECK(done == pixels);
  CHECK(wrong == 0);
}

TEST_CASE("an image that is too large for the rasterizer's numbers is refused") {
  CHECK_THROWS_AS(raster_camera({40000, 2, 100, 100, 150, 1}, Pose::Identity(), true), InternalError);
  CHECK_THROWS_AS(raster_camera({8000, 8000, 100, 100, 150, 1}, Pose::Identity(), true), InternalError);
}

TEST_CASE("a pixel shows the same whichever others are asked for with it") {
  const Camera camera{40, 4, 30, 30, 12, 1};
  const OneFace face(6, 0.f, 1.f);
  RasterBand band;
  band.end_row = camera.rows;
  band.texels = {face.as_chunk(0)};
  add_triangle(band, 0);
  const auto pixels = static_cast<std::size_t>(camera.pixels());
  band.shown.reserve(pixels + RasterBand::kSpare);
  std::fill_n(band.shown.data(), pixels, 0u);
  RasterLookup lookup(raster_camera(camera, Pose::Identity(), true), {true, false, 0.2f, 99});
  std::vector<float> range;
  for (std::uint32_t p = 0; p < pixels; ++p) {
    lookup.find(band, std::span(&p, 1));
    range.push_back(lookup.at.range[0]);
  }
  // Lists that end as far from where their last group begins as neighbours would, but have gaps: 14 of 16 pixels, say.
  for (std::uint32_t first = 0; first + 16 < pixels; ++first) {
    for (std::uint32_t left_out = 1; left_out < 15; ++left_out) {
      std::vector<std::uint32_t> asked;
      for (std::uint32_t k = 0; k < 16; ++k)
        if (k != left_out && k != 5) asked.push_back(first + k);
      REQUIRE(lookup.find(band, asked) == asked.size());
      for (std::size_t i = 0; i < asked.size(); ++i) CHECK(lookup.at.range[i] == range[asked[i]]);
    }
  }
}
