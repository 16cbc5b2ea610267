#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "framework/graph/graph.hpp"
#include "framework/slam/frame.hpp"
#include "modules/maps/ppm/meshed_room.hpp"
#include "modules/prediction/warp_kernel.hpp"
#include "tests/prediction/agreement_scenes.hpp"
#include "tests/support/registry.hpp"
#include "tests/support/simd_targets.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

const Camera kCamera{75, 58, 60, -60, 37, 28.5};

std::shared_ptr<const PpmMap> small_room() {
  static const auto map = map_of(
      meshed_room(6000), {}, [](const Eigen::Vector3f& p) { return 0.01f * std::sin(5 * p.x()); }, 1e-4f);
  return map;
}

/// For a camera whose rows grow against its y axis.
Pose somewhere(double angle = 0.4) {
  return room_view(angle) * Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitZ());
}

std::vector<Pose> cloud(const Pose& centre, std::size_t n, double sigma_m, double sigma_deg) {
  Rng rng(5, 0, 0, 0);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < n; ++i) {
    Twist xi;
    for (int k = 0; k < 6; ++k) xi[k] = (k < 3 ? sigma_m : sigma_deg * EIGEN_PI / 180) * rng.normal();
    poses.push_back(centre * se3_exp(xi));
  }
  return poses;
}

/// A module's views of a map, and what they show of all pixels.
struct Looked {
  Looked(const std::string& module, const std::string& params, const std::shared_ptr<const PpmMap>& map,
         const Camera& camera, const std::vector<Pose>& poses, int threads = 1)
      : harness(builtin(), module, params, threads) {
    auto frame = std::make_shared<Frame>();
    frame->camera = camera;
    frame->depth.assign(static_cast<std::size_t>(camera.pixels()), 1.5f);
    harness.input<Frame>("frame", frame);
    harness.belief().init(poses.size(), poses.front(), map);
    harness.belief().pose = poses;
    harness.tick();
    for (const auto& view : harness.belief().prediction) {
      std::vector<std::uint32_t> pixels(static_cast<std::size_t>(view->camera.pixels()));
      std::iota(pixels.begin(), pixels.end(), 0u);
      samples.emplace_back().resize(pixels.size(), view->color_channels);
      view->sample(pixels, samples.back());
    }
  }
  double metric(const std::string& name) {
    for (const auto& [column, rows] : harness.context().metrics().columns())
      if (column.ends_with("." + name)) return rows.back().value;
    FAIL("no metric " << name);
    return 0;
  }
  Harness harness;
  std::vector<ViewSamples> samples;
};

/// Share of the pixels where both miss, or both hit at ranges that differ by less than `most`, and alike in variance
/// and cosine.
double agreeing(const ViewSamples& a, const ViewSamples& b, float most) {
  std::size_t alike = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.range[i] == Prediction::kMiss || b.range[i] == Prediction::kMiss)
      alike += a.range[i] == b.range[i];
    else
      alike += std::abs(a.range[i] - b.range[i]) < most && std::abs(a.cosine[i] - b.cosine[i]) < 0.05f &&
               std::abs(std::log(a.variance[i] / b.variance[i])) < 0.3f;
  }
  return static_cast<double>(alike) / static_cast<double>(a.size());
}

bool same_bytes(const ViewSamples& a, const ViewSamples& b) {
  return a.range == b.range && a.variance == b.variance && a.cosine == b.cosine && a.color == b.color;
}

}  // namespace

TEST_CASE("prediction.shared_view: at the shared pose it shows what an exact view shows") {
  const int stride = GENERATE(1, 2);
  const auto params = fmt::format("stride: {}", stride);
  const Looked exact("prediction.raster", "{" + params + "}", small_room(), kCamera, {somewhere()});
  Looked shared("prediction.shared_view", "{group_least: 1, " + params + "}", small_room(), kCamera, {somewhere()});
  CHECK(shared.metric("shared") == 1);
  CHECK(agreeing(exact.samples[0], shared.samples[0], 1e-4f) > 0.999);
}

TEST_CASE("prediction.shared_view: particles near by see the surface from where they are") {
  const auto poses = cloud(somewhere(), 20, 0.01, 0.5);
  const Looked exact("prediction.raster", "{}", small_room(), kCamera, poses);
  Looked shared("prediction.shared_view", "{}", small_room(), kCamera, poses);
  CHECK(shared.metric("groups") == 1);
  CHECK(shared.metric("shared") == 20);
  CHECK(shared.metric("own") == 0);
  for (std::size_t i = 0; i < poses.size(); ++i) CHECK(agreeing(exact.samples[i], shared.samples[i], 0.004f) > 0.92);
  // Without the planes, 1 cm and half a degree would show.
  CHECK(agreeing(exact.samples[0], exact.samples[1], 0.004f) < 0.6);
}

TEST_CASE("prediction.shared_view: more detail, better views") {
  const auto poses = cloud(somewhere(), 10, 0.01, 0.5);
  const Looked exact("prediction.raster", "{}", small_room(), kCamera, poses);
  double worse = 0, better = 0;
  const Looked coarse("prediction.shared_view", "{detail: 1}", small_room(), kCamera, poses);
  const Looked fine("prediction.shared_view", "{detail: 3}", small_room(), kCamera, poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    worse += agreeing(exact.samples[i], coarse.samples[i], 0.001f);
    better += agreeing(exact.samples[i], fine.samples[i], 0.001f);
  }
  CHECK(better > worse);
}

TEST_CASE("prediction.shared_view: beyond the limits, or in small company, views are exact") {
  auto poses = cloud(somewhere(), 6, 0.002, 0.1);
  poses.push_back(somewhere(0.6));
  poses.push_back(somewhere() * Eigen::Translation3d(0.2, 0, 0));
  poses.push_back(poses[6]);  // a copy
  const Looked exact("prediction.raster", "{}", small_room(), kCamera, poses);
  Looked shared("prediction.shared_view", "{distance_most: 2 cm, angle_most: 1 deg}", small_room(), kCamera, poses);
  CHECK(shared.metric("shared") == 6);
  CHECK(shared.metric("own") == 2);
  for (std::size_t i = 6; i < 9; ++i) CHECK(same_bytes(exact.samples[i], shared.samples[i]));
  Looked alone("prediction.shared_view", "{group_least: 7}", small_room(), kCamera, poses);
  CHECK(alone.metric("groups") == 0);
  for (std::size_t i = 0; i < 9; ++i) CHECK(same_bytes(exact.samples[i], alone.samples[i]));
}

TEST_CASE("prediction.shared_view: the same bytes for any number of threads, on every target") {
  const auto poses = cloud(somewhere(), 12, 0.01, 0.5);
  const Looked one("prediction.shared_view", "{}", small_room(), kCamera, poses);
  const Looked three("prediction.shared_view", "{}", small_room(), kCamera, poses, 3);
  for (std::size_t i = 0; i < poses.size(); ++i) CHECK(same_bytes(one.samples[i], three.samples[i]));
  on_every_target([&] {
    const Looked here("prediction.shared_view", "{}", small_room(), kCamera, poses);
    for (std::size_t i = 0; i < poses.size(); ++i) CHECK(same_bytes(one.samples[i], here.samples[i]));
  });
}

TEST_CASE("prediction.shared_view: an empty map shows nothing, an edge of the map stays where it is") {
  const auto poses = cloud(somewhere(), 8, 0.02, 0.5);
  const Looked empty("prediction.shared_view", "{}", std::make_shared<PpmMap>(PpmSettings{}), kCamera, poses);
  for (const auto& view : empty.samples)
    CHECK(std::all_of(view.range.begin(), view.range.end(), [](float r) { return r == Prediction::kMiss; }));

  TriangleMesh wall;  // 2 m away, its edge in the middle of the image
  wall.position = {{0, -9, 2}, {-9, 0, 2}, {0, 9, 2}};
  wall.face = {{0, 1, 2}};
  const auto map = map_of(wall, {}, [](const Eigen::Vector3f&) { return 0.f; }, 1e-4f);
  const auto before = cloud(Pose::Identity(), 8, 0.05, 0.2);
  const Looked exact("prediction.raster", "{backfaces: hit}", map, kCamera, before);
  const Looked shared("prediction.shared_view", "{backfaces: hit, distance_most: 1}", map, kCamera, before);
  for (std::size_t i = 0; i < before.size(); ++i)
    CHECK(agreeing(exact.samples[i], shared.samples[i], 0.001f) > 0.98);
}

TEST_CASE("prediction.shared_view: arrays on demand say what samples say, with colour") {
  const Scene scene = mapped_room();
  const auto poses = cloud(scene.looks[0].T_map_camera, 6, 0.003, 0.2);
  const Looked exact("prediction.raster", "{}", scene.map, scene.looks[0].camera, poses);
  Looked shared("prediction.shared_view", "{}", scene.map, scene.looks[0].camera, poses);
  PredictionPool pool;
  const Workers workers(2);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto whole = completed(shared.harness.belief().prediction[i], pool, workers);
    std::vector<std::uint32_t> pixels(whole->range.size());
    std::iota(pixels.begin(), pixels.end(), 0u);
    ViewSamples from_arrays;
    from_arrays.resize(pixels.size(), 3);
    whole->sample(pixels, from_arrays);
    CHECK(from_arrays.color == shared.samples[i].color);
    CHECK(agreeing(from_arrays, shared.samples[i], 0.002f) > 0.97);
    std::size_t alike = 0, hits = 0;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      if (!whole->hit(p)) continue;
      ++hits;
      alike += std::abs(shared.samples[i].color[3 * p] - exact.samples[i].color[3 * p]) < 0.05f;
    }
    CHECK(alike > 0.9 * static_cast<double>(hits));
  }
}

TEST_CASE("prediction.shared_view: a map is not updated from it, and the file says so") {
  const std::string graph = R"(name: g
nodes:
  - {name: camera, module: source.synthetic_room}
  - {name: init, module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}}
  - {name: look, module: prediction.shared_view, in: {frame: camera.frame}}
  - {name: update, module: map_update.ppm_bayes, in: {frame: camera.frame}}
)";
  try {
    Graph::build(parse_yaml(graph, "g.yaml"), builtin());
    FAIL("no error");
  } catch (const ConfigError& e) {
    CHECK(std::string(e.what()).find("g.yaml:6:28: node 'update' needs an exact view of each particle "
                                     "('prediction.elements'), which no node gives; modules that do: prediction.embree") == 0);
  }
}
