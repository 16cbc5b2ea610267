#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <hwy/highway.h>

#include "framework/slam/frame.hpp"
#include "modules/maps/ppm/meshed_room.hpp"
#include "modules/prediction/raster_drawing.hpp"
#include "tests/prediction/backends.hpp"
#include "tests/prediction/whole_views.hpp"
#include "tests/support/mesh_map.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

const Camera kCamera{75, 58, 60, -60, 37, 28.5};  // sides that no vector divides

std::shared_ptr<const PpmMap> small_room() {
  static const auto map = map_of(
      meshed_room(6000), {}, [](const Eigen::Vector3f& p) { return 0.01f * std::sin(5 * p.x()); }, 1e-4f);
  return map;
}

/// For a camera whose rows grow against its y axis.
Pose askew(double angle) {
  return room_view(angle) * Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitZ());
}

/// A view by one module, all arrays.
PredictionHandle by_module(const std::string& module, const std::string& params,
                           const std::shared_ptr<const PpmMap>& map, const Camera& camera, const Pose& pose) {
  Harness h(builtin(), module, params);
  auto frame = std::make_shared<Frame>();
  frame->camera = camera;
  h.input<Frame>("frame", frame);
  h.belief().init(1, pose, map);
  h.tick();
  return filled(h.belief().prediction[0]);
}

/// A view drawn in bands of so many rows, the last ones first, all arrays.
Prediction in_bands(const PpmMap& map, const Camera& camera, const Pose& pose, int rows,
                    const RasterOptions& options = {}) {
  Prediction out;
  out.reset(camera, 1, pose);
  RasterView view;
  RasterScratch scratch;
  view.start(map, out, options);
  for (int first = (camera.rows - 1) / rows * rows; first >= 0; first -= rows)
    draw_rows({first, std::min(first + rows, camera.rows)}, view, scratch);
  view.fill(out, all_rows(camera), out);
  return out;
}

std::size_t hits(const Prediction& view) {
  return static_cast<std::size_t>(
      std::count_if(view.chunk.begin(), view.chunk.end(), [](auto c) { return c != Prediction::kNone; }));
}

std::shared_ptr<const PpmMap> soup(std::uint64_t seed) {
  return make_map(triangle_soup(400, seed), {}, [](const Eigen::Vector3f& p) { return 0.01f * p.x(); });
}

/// Runs body once for each set of instructions that this machine has.
template <class Body>
void for_each_target(const Body& body) {
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    body(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
}

}  // namespace

TEST_CASE("a drawn view is the same bytes on every set of instructions") {
  const auto room = small_room(), mixed = soup(3);
  const auto view = [&] {
    return bytes_of(in_bands(*room, kCamera, askew(0.3), 58)) +
           bytes_of(in_bands(*mixed, kCamera, Pose::Identity(), 58)) +
           bytes_of(in_bands(*mixed, kCamera, Pose::Identity(), 58, {false, false}));
  };
  const std::string best = view();
  int targets = 0;
  for_each_target([&](const char* name) {
    INFO(name);
    CHECK(view() == best);
    ++targets;
  });
  CHECK(targets > 1);
}

TEST_CASE("a drawn view is the same bytes in bands of any height") {
  for (std::uint64_t seed : {1, 2, 3}) {
    const auto map = seed == 1 ? small_room() : soup(seed);
    const Pose pose = seed == 1 ? askew(2) : Pose::Identity();
    const Prediction whole = in_bands(*map, kCamera, pose, kCamera.rows);
    CHECK(hits(whole) > 2000);
    for (int rows : {1, 5, 16, 29}) CHECK(bytes_of(in_bands(*map, kCamera, pose, rows)) == bytes_of(whole));
  }
}

TEST_CASE("parameters of prediction.raster mean what those of prediction.embree mean") {
  const std::string params = GENERATE("{}", "{backfaces: hit}", "{texel: nearest}", "{backfaces: hit, stride: 3}");
  CAPTURE(params);
  for (std::uint64_t seed : {4, 5}) {
    const auto map = soup(seed);
    const auto drawn = by_module("prediction.raster", params, map, kCamera, Pose::Identity());
    const auto traced = by_module("prediction.embree", params, map, kCamera, Pose::Identity());
    std::size_t different = 0, wrong = 0;
    for (std::size_t p = 0; p < traced->range.size(); ++p) {
      if (drawn->chunk[p] != traced->chunk[p] || drawn->face[p] != traced->face[p]) {
        ++different;
        continue;
      }
      if (!traced->hit(p)) continue;
      wrong += std::abs(drawn->range[p] - traced->range[p]) > 1e-4f * (1 + traced->range[p]);
      wrong += drawn->normal[3 * p] != Approx(traced->normal[3 * p]).margin(1e-4);
      const bool at_another_texel = params == "{texel: nearest}" && std::abs(drawn->mean[p] - traced->mean[p]) < 0.02f;
      wrong += !at_another_texel && std::abs(drawn->mean[p] - traced->mean[p]) > 1e-4f;
    }
    CHECK(hits(*drawn) > drawn->range.size() / 2);
    CHECK(different <= traced->range.size() / 500);
    CHECK(wrong == 0);
  }
}

TEST_CASE("an image of one pixel, an empty map and a camera close to a surface are drawn") {
  const Camera one{1, 1, 60, 60, 0, 0};
  const auto map = small_room();
  CHECK(by_module("prediction.raster", "{}", map, one, room_view(1))->hit(0));
  const auto nothing =
      by_module("prediction.raster", "{}", std::make_shared<const PpmMap>(PpmSettings{}), kCamera, room_view(1));
  CHECK(hits(*nothing) == 0);
  // A wall all over the image and beyond the camera's plane, 1 mm in front of the camera's centre.
  TriangleMesh wall{{{-2, -2, -0.4f}, {-2, 2, -0.4f}, {2, -2, 0.403f}, {2, 2, 0.403f}}, {{0, 1, 2}, {2, 1, 3}}};
  const auto near = by_module("prediction.raster", "{}", make_map(wall), kCamera, Pose::Identity());
  const auto traced = by_module("prediction.embree", "{}", make_map(wall), kCamera, Pose::Identity());
  CHECK(near->face == traced->face);
}

TEST_CASE("two faces at the same depth show the one of the lower number, whatever is drawn first") {
  TriangleMesh wall{{{-2, -2, 2}, {-2, 2, 2}, {2, -2, 2}}, {{0, 1, 2}}};
  TriangleMesh twice = wall;
  twice.position.insert(twice.position.end(), wall.position.begin(), wall.position.end());
  twice.face.insert(twice.face.begin(), {3, 4, 5});
  const auto view = in_bands(*make_map(twice), kCamera, Pose::Identity(), 7);
  CHECK(hits(view) > 1000);
  CHECK(std::count(view.face.begin(), view.face.end(), 1u) == 0);
}

TEST_CASE("prediction.raster refuses words that it does not know") {
  CHECK_THROWS_AS(Harness(builtin(), "prediction.raster", "{backfaces: maybe}"), ConfigError);
  CHECK_THROWS_AS(Harness(builtin(), "prediction.raster", "{packet: 4}"), ConfigError);
}
