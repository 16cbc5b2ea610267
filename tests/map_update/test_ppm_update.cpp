#include <algorithm>
#include <catch2/catch.hpp>

#include "framework/graph/harness.hpp"
#include "modules/builtin.hpp"
#include "tests/map_update/box_world.hpp"
#include "tests/map_update/mapper.hpp"
#include "tests/support/workers.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr double kSigma = 0.004;

BoxWorld room_with_box() {
  BoxWorld scene;
  scene.boxes.emplace_back(Eigen::Vector3d(-0.3, 0.4, 1.5), Eigen::Vector3d(0.3, 1.2, 2.1));
  return scene;
}

/// Share of the pixels that the map covers, and the largest error of the range among the given best share of them.
struct Agreement {
  double coverage, error_m;
};
Agreement agreement(Mapper& mapper, const BoxWorld& scene, const Pose& pose, double share) {
  const Camera camera = small_camera();
  const auto seen = mapper.predict(camera, pose);
  std::vector<double> errors;
  for (int y = 0; y < camera.rows; ++y)
    for (int x = 0; x < camera.cols; ++x) {
      const auto p = static_cast<std::size_t>(y * camera.cols + x);
      if (!seen.hit(p)) continue;
      const Eigen::Vector3d ray = (pose.linear() * camera.ray(x, y)).normalized();
      const Eigen::Vector3d normal(seen.normal[3 * p], seen.normal[3 * p + 1], seen.normal[3 * p + 2]);
      const double range = seen.range[p] + seen.mean[p] / normal.dot(ray);
      errors.push_back(std::abs(range - scene.distance(pose.translation(), ray)));
    }
  std::sort(errors.begin(), errors.end());
  return {static_cast<double>(errors.size()) / camera.pixels(),
          errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))]};
}

}  // namespace

TEST_CASE("one image of a flat wall gives a few large faces that lie on it") {
  BoxWorld scene;
  Mapper mapper;
  const Pose pose = look({0, 0, 1.8});  // nothing but the far wall in view
  mapper.add(scene.frame(small_camera(), pose, kSigma, 0, false));
  CHECK(mapper.map().stats().faces < 60);  // 80x60 pixels in leaves of 16 pixels: 40 triangles where no leaf is split
  const auto a = agreement(mapper, scene, pose, 1.0);
  CHECK(a.coverage > 0.94);  // all but the rays along the border
  CHECK(a.error_m < 1e-4);
}

TEST_CASE("views of a room from all sides make one map, of one layer, that agrees with the room") {
  const auto scene = room_with_box();
  Mapper mapper;
  for (int i = 0; i < 24; ++i)
    mapper.add(scene.frame(small_camera(), look({0.2, 0, 0.2}, 0.05 * i - 0.6, 0.1), kSigma,
                           static_cast<std::uint32_t>(i), true));
  CHECK(mapper.second_layers(small_camera(), look({0.2, 0, 0.2}, 0.1, 0.1)) < 0.002);
  const auto a = agreement(mapper, scene, look({0.22, 0.02, 0.2}, 0.1, 0.12), 0.95);
  CHECK(a.coverage > 0.93);
  CHECK(a.error_m < 0.02);
}

TEST_CASE("a second view that overlaps the first is stitched to it: no crack, no second layer") {
  const BoxWorld scene;
  Mapper mapper;
  mapper.add(scene.frame(small_camera(), look({-0.3, 0, 1.5}), kSigma, 0, false));
  mapper.add(scene.frame(small_camera(), look({0.3, 0, 1.5}), kSigma, 1, false));
  const auto middle = look({0, 0, 1.5});
  CHECK(mapper.second_layers(small_camera(), middle) == 0);
  const auto seen = mapper.predict(small_camera(), middle);
  int misses = 0;
  for (int y = 2; y < 58; ++y)
    for (int x = 2; x < 78; ++x) misses += !seen.hit(static_cast<std::size_t>(y * 80 + x));
  CHECK(misses == 0);
}

TEST_CASE("a view from afar makes texels no finer than its pixels, one from near those of the map") {
  const BoxWorld scene;
  const auto texels = [&](double z, float least_pixels) {
    UpdateSettings settings;
    settings.texels.least_pixels = least_pixels;
    Mapper mapper(settings);
    mapper.add(scene.frame(small_camera(), look({0, 0, z}), kSigma, 0, false));
    return mapper.map().stats().texels;
  };
  CHECK(texels(-0.9, 2) < texels(-0.9, 0) / 4);  // the far wall is 3.9 m away: 2 pixels are 11 cm
  CHECK(texels(2.5, 1) == texels(2.5, 0));       // 0.5 m: a pixel is 7 mm, a texel 2 cm
}

TEST_CASE("a camera whose image rows grow against its y axis maps the same room") {
  const auto scene = room_with_box();
  Camera camera = small_camera();
  camera.fy = -camera.fy;
  Mapper mapper;
  for (std::uint32_t i = 0; i < 12; ++i)
    mapper.add(scene.frame(camera, look({0.2, 0, 0.2}, 0.05 * i - 0.3, 0.1), kSigma, i, true));
  const auto a = agreement(mapper, scene, look({0.22, 0.02, 0.2}, 0, 0.12), 0.95);
  CHECK(a.coverage > 0.93);  // back faces are not hit: a mesh wound the wrong way round would show nothing
  CHECK(a.error_m < 0.02);
  CHECK(mapper.second_layers(small_camera(), look({0.2, 0, 0.2}, 0.1, 0.1)) < 0.002);
}

TEST_CASE("with a prediction of every second pixel the update works on that grid") {
  const BoxWorld scene;
  const Frame frame = scene.frame(small_camera(), look({0, 0, 1.8}), kSigma, 0, false);
  Prediction seen;
  seen.reset(frame.camera, 2, *frame.T_world_camera_ref);
  UpdateSettings settings;
  settings.share();
  UpdateScratch scratch;
  const auto map =
      update_map(std::make_shared<const PpmMap>(PpmSettings{}), frame, seen, settings, 0, test::one_worker(), scratch);
  map->check();
  CHECK(map->stats().faces > 8);
  CHECK(map->stats().faces < 60);  // 40x30 pixels in leaves of 16
  Prediction wrong;
  wrong.reset(frame.camera.decimated(2), 1, *frame.T_world_camera_ref);
  CHECK_THROWS_AS(update_map(map, frame, wrong, settings, 1, test::one_worker(), scratch), InternalError);
}

TEST_CASE("an update with nothing new changes no face") {
  const auto scene = room_with_box();
  Mapper mapper;
  for (int i = 0; i < 6; ++i) mapper.add(scene.frame(small_camera(), look({0, 0, 0}), kSigma, 0, false));
  const auto faces = mapper.map().stats().faces;
  for (int i = 0; i < 4; ++i) mapper.add(scene.frame(small_camera(), look({0, 0, 0}), kSigma, 0, false));
  CHECK(mapper.map().stats().faces == faces);
}

TEST_CASE("a box that appears gets faces of its own, one that goes away is seen through and goes") {
  BoxWorld empty, full = room_with_box();
  Mapper mapper;
  std::uint32_t i = 0;
  const Pose pose = look({0, 0, 0.3}, 0, -0.15);
  const auto add = [&](const BoxWorld& scene, int frames) {
    for (int k = 0; k < frames; ++k, ++i) mapper.add(scene.frame(small_camera(), pose, kSigma, i, true));
  };
  const auto error = [&](const BoxWorld& scene) { return agreement(mapper, scene, pose, 0.97).error_m; };
  add(empty, 3);
  CHECK(error(empty) < 0.03);
  CHECK(error(full) > 0.1);
  add(full, 3);
  CHECK(error(full) < 0.03);
  add(empty, 16);
  CHECK(error(empty) < 0.03);
}

TEST_CASE("a box that stood for 200 frames is gone after 30 that see through it") {
  const BoxWorld empty, full = room_with_box();
  Mapper mapper;
  const Pose pose = look({0, 0, 0.3}, 0, -0.15);
  std::uint32_t i = 0;
  for (; i < 3; ++i) mapper.add(empty.frame(small_camera(), pose, kSigma, i, true));
  for (; i < 203; ++i) mapper.add(full.frame(small_camera(), pose, kSigma, i, true));
  CHECK(agreement(mapper, full, pose, 0.97).error_m < 0.03);
  for (; i < 233; ++i) mapper.add(empty.frame(small_camera(), pose, kSigma, i, true));
  const auto a = agreement(mapper, empty, pose, 0.97);
  CHECK(a.error_m < 0.03);
  CHECK(a.coverage > 0.93);  // all but the rays along the border
}

TEST_CASE("somebody who walks through a room leaves nothing behind") {
  const BoxWorld empty;
  Mapper mapper;
  const Pose pose = look({0, 0, -0.5});
  std::uint32_t i = 0;
  for (; i < 5; ++i) mapper.add(empty.frame(small_camera(), pose, kSigma, i, true));
  for (; i < 65; ++i) {
    BoxWorld walk;
    const double x = -1.8 + 0.05 * (i - 5);
    walk.boxes.emplace_back(Eigen::Vector3d(x, -0.5, 1.2), Eigen::Vector3d(x + 0.4, 1.2, 1.5));
    mapper.add(walk.frame(small_camera(), pose, kSigma, i, true));
  }
  for (; i < 90; ++i) mapper.add(empty.frame(small_camera(), pose, kSigma, i, true));
  const auto a = agreement(mapper, empty, pose, 0.97);
  CHECK(a.error_m < 0.03);
  CHECK(a.coverage > 0.95);
}

TEST_CASE("invariants hold after every frame of a random path through a cluttered room") {
  BoxWorld scene = room_with_box();
  Rng rng(5, 0, 0, purpose_key("path"));
  for (int b = 0; b < 6; ++b) {
    const Eigen::Vector3d low(3 * rng.uniform() - 1.5, 2 * rng.uniform() - 1, 1 + 1.5 * rng.uniform());
    scene.boxes.emplace_back(
        low, low + Eigen::Vector3d(0.1 + 0.4 * rng.uniform(), 0.1 + 0.4 * rng.uniform(), 0.1 + 0.4 * rng.uniform()));
  }
  PpmSettings small_cells;
  small_cells.cell_size_m = 0.4;  // many chunk borders
  Mapper mapper({}, small_cells);
  for (std::uint32_t i = 0; i < 25; ++i) {
    const Pose pose = look({0.6 * rng.uniform() - 0.3, 0.4 * rng.uniform() - 0.2, 0.5 * rng.uniform() - 0.5},
                           rng.uniform() - 0.5, 0.6 * rng.uniform() - 0.3);
    mapper.add(scene.frame(small_camera(), pose, kSigma, i, true));  // checks the map
  }
  CHECK(mapper.map().stats().chunks > 30);
}

TEST_CASE("map_update.ppm_bayes gives the same bytes for 1, 2 and 4 threads, and leaves other particles' maps alone") {
  Registry registry;
  register_builtin(registry);
  const auto scene = room_with_box();
  std::vector<std::string> digests;
  for (int threads : {1, 2, 4}) {
    Harness h(registry, "map_update.ppm_bayes", "{}", threads);
    EmbreeScenes scenes{EmbreeOptions{}};
    const Workers workers(1);
    const auto empty = std::make_shared<const PpmMap>(PpmSettings{});
    h.belief().init(5, look({0, 0, 0}), empty);
    for (std::uint32_t i = 0; i < 4; ++i) {
      auto frame = std::make_shared<const Frame>(scene.frame(small_camera(), look({0, 0, 0}), kSigma, i, true));
      h.input<Frame>("frame", frame);
      for (std::size_t k = 0; k < h.belief().size(); ++k) {
        h.belief().pose[k] = look({0.002 * static_cast<double>(k), 0, 0}, 0.01 * static_cast<double>(k) * i);
        const auto& map = static_cast<const PpmMap&>(*h.belief().map[k]);
        scenes.update({&map}, workers);
        auto seen = std::make_shared<Prediction>();
        seen->reset(small_camera(), 1, h.belief().pose[k]);
        trace_view(map, scenes.of(map), EmbreeViewOptions{}, all_rows(seen->camera), *seen);
        h.belief().prediction[k] = seen;
      }
      h.tick();
    }
    CHECK(empty->stats().faces == 0);
    Digest digest;
    for (const auto& map : h.belief().map) map->digest(digest);
    digests.push_back(digest.hex());
  }
  CHECK(digests[0] == digests[1]);
  CHECK(digests[0] == digests[2]);
}
