#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/rng.hpp"
#include "tests/map_update/gather_reference.hpp"
#include "tests/map_update/views.hpp"
#include "tests/support/simd_targets.hpp"
#include "tests/support/workers.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

float wavy_depth(int x, int y) {
  if ((x * 7 + y * 13) % 23 == 0) return NAN;
  return 1.2f + 0.3f * std::sin(0.05f * static_cast<float>(x)) + 0.01f * static_cast<float>(y) + (x > 50 ? 0.5f : 0.0f);
}

/// Far from the map's origin, looking askew.
const Pose kPose = look({300, -200, 100}, 0.7, -0.3);

/// Faces of many sizes near what an image measures, some across its border, some behind the camera, half of them seen
/// from behind. Texels are random.
struct Faces {
  Geometry geometry;
  Texels texels;

  explicit Faces(std::uint32_t seed, int count = 400) {
    Rng rng(seed, 0, 0, 0);
    const auto between = [&](double a, double b) { return a + (b - a) * rng.uniform(); };
    const Camera camera = small_camera();
    for (int f = 0; f < count; ++f) {
      const double x = between(-10, 90), y = between(-10, 70), size = between(1, 12), off = between(-0.04, 0.04);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const double u = x + between(-size, size), v = y + between(-size, size);
        const float z = wavy_depth(static_cast<int>(u), static_cast<int>(v));
        const double depth = f % 20 == 0 ? -1.0 : (z == z ? z : 1.5) + off;
        geometry.position.push_back((kPose * (depth * camera.ray(u, v))).cast<float>());
      }
      const auto first = static_cast<std::uint32_t>(3 * f);
      geometry.face.push_back({first, first + 1, first + 2});
      const auto n = static_cast<std::uint8_t>(f % 5 == 0 ? between(1, 40) : between(1, 7));
      geometry.divisions.push_back(n);
      geometry.first_texel.push_back(static_cast<std::uint32_t>(texels.size()));
      texels.evidence.push_back({0, 0, static_cast<float>(between(-1e-5, 5e-5))});
      for (std::uint32_t t = 0; t < texel_count(n); ++t) {
        texels.mean.push_back(static_cast<float>(between(-0.02, 0.02)));
        texels.variance.push_back(static_cast<float>(between(1e-6, 2e-3)));
      }
    }
  }

  std::vector<std::uint32_t> every(std::uint32_t step) const {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < geometry.face.size(); f += step) faces.push_back(f);
    return faces;
  }
};

struct Scene {
  Frame frame = frame_of(wavy_depth);
  Prediction nothing;
  UpdateView view;
  TexelSettings settings;

  Scene() {
    nothing.reset(small_camera(), 1, kPose);
    view.build(frame, nothing, one_worker());
  }
  void gather(const std::vector<std::uint32_t>& faces, Faces& of) const {
    gather_faces(gather_image(view), gather_gate(settings), gather_faces_of(of.geometry, of.texels), faces.data(),
                 faces.size());
  }
};

}  // namespace

TEST_CASE("texels that gather by vectors agree with the reference, one texel at a time") {
  const Scene scene;
  const GatherReference reference(scene.view, scene.settings);
  std::size_t updated = 0, wrong = 0, texels = 0;
  for (std::uint32_t seed : {1u, 2u, 3u}) {
    Faces given(seed), expected = given;
    const Faces before = given;
    scene.gather(given.every(1), given);
    for (auto f : given.every(1)) {
      const auto first = given.geometry.first_texel[f];
      reference.update(corners_in(scene.view, given.geometry, f), given.geometry.divisions[f],
                       given.texels.evidence[f].added_variance(), &expected.texels.mean[first],
                       &expected.texels.variance[first]);
    }
    for (std::size_t t = 0; t < given.texels.size(); ++t) {
      const auto near = [](float a, float b, double margin) { return a == Approx(b).epsilon(1e-3).margin(margin); };
      updated += given.texels.variance[t] != before.texels.variance[t];
      // Where rounding decides on which side of a gate, of half a weight or of the image's border a texel lies, it may
      // differ.
      wrong += !near(given.texels.mean[t], expected.texels.mean[t], 2e-6) ||
               !near(given.texels.variance[t], expected.texels.variance[t], 1e-9);
    }
    texels += given.texels.size();
  }
  CHECK(updated > texels / 10);
  CHECK(updated < texels);
  CHECK(wrong <= texels / 1000);
}

TEST_CASE("texels gather the same bytes on every instruction set, and however faces are grouped") {
  const Scene scene;
  Faces whole(5);
  scene.gather(whole.every(1), whole);
  on_every_target([&] {
    Faces same(5), one_by_one(5);
    scene.gather(same.every(1), same);
    for (auto f : one_by_one.every(1)) scene.gather({f}, one_by_one);
    CHECK(same.texels.mean == whole.texels.mean);
    CHECK(same.texels.variance == whole.texels.variance);
    CHECK(one_by_one.texels.mean == whole.texels.mean);
    CHECK(one_by_one.texels.variance == whole.texels.variance);
  });
}

TEST_CASE("gathering touches the texels of the faces that it is given, and no others") {
  const Scene scene;
  on_every_target([&] {
    Faces whole(6), some(6);
    const Faces before = some;
    scene.gather(whole.every(1), whole);
    scene.gather(some.every(3), some);
    for (std::uint32_t f = 0; f < some.geometry.face.size(); ++f) {
      const auto first = some.geometry.first_texel[f];
      const Faces& expected = f % 3 == 0 ? whole : before;
      const auto count = static_cast<std::ptrdiff_t>(texel_count(some.geometry.divisions[f]));
      const auto from = expected.texels.variance.begin() + first;
      CHECK(std::equal(from, from + count, some.texels.variance.begin() + first));
    }
  });
}

TEST_CASE("texels read each stride-th pixel of a larger image as they read the decimated one") {
  const Scene scene;
  Faces small(7), large(7);
  scene.gather(small.every(1), small);
  constexpr int kStride = 3;
  std::vector<float> depth(static_cast<std::size_t>(240 * 180), 0.7f), sigma(depth.size(), 1.0f);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      const auto to = static_cast<std::size_t>(y * kStride * 240 + x * kStride);
      depth[to] = scene.frame.depth[static_cast<std::size_t>(y * 80 + x)];
      sigma[to] = scene.frame.sigma[static_cast<std::size_t>(y * 80 + x)];
    }
  GatherImage image = gather_image(scene.view);
  image.row_step = kStride * 240;
  image.col_step = kStride;
  image.depth = depth.data();
  image.sigma = sigma.data();
  const auto faces = large.every(1);
  gather_faces(image, gather_gate(scene.settings), gather_faces_of(large.geometry, large.texels), faces.data(),
               faces.size());
  CHECK(large.texels.mean == small.texels.mean);
  CHECK(large.texels.variance == small.texels.variance);
}
