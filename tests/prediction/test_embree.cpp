#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "framework/core/se3.hpp"
#include "framework/graph/harness.hpp"
#include "framework/slam/frame.hpp"
#include "modules/builtin.hpp"
#include "tests/prediction/whole_views.hpp"
#include "tests/support/mesh_map.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

const Camera kCamera{50, 38, 40, -40, 24.5, 18.5};

Registry builtin() {
  Registry r;
  register_builtin(r);
  return r;
}

std::shared_ptr<const Frame> frame_of(const Camera& camera) {
  auto frame = std::make_shared<Frame>();
  frame->camera = camera;
  return frame;
}

// Predictions of n particles around the origin that look at the maps in turn.
std::vector<PredictionHandle> predictions(const std::string& params, std::vector<std::shared_ptr<const PpmMap>> maps,
                                          std::size_t n, int threads = 1) {
  const Registry registry = builtin();
  Harness h(registry, "prediction.embree", params, threads);
  h.input<Frame>("frame", frame_of(kCamera));
  h.belief().init(n, Pose::Identity(), nullptr);
  for (std::size_t i = 0; i < n; ++i) {
    const double k = static_cast<double>(i);
    h.belief().pose[i] = se3_exp((Twist() << 0.01 * k, 0.003, 0.02, 0.002 * k, 0.01, 0.03 * k).finished());
    h.belief().map[i] = maps[i % maps.size()];
  }
  h.tick();
  return whole_views(h.belief());
}

std::string bytes_of(const std::vector<PredictionHandle>& all) {
  Digest digest;
  for (const auto& p : all) {
    digest.add(p->range);
    digest.add(p->mean);
    digest.add(p->variance);
    digest.add(p->normal);
    digest.add(p->chunk);
    digest.add(p->face);
    digest.add(p->bary);
  }
  return digest.hex();
}

// A square of side 4 m at depth z, seen from the origin's side or from behind.
TriangleMesh square(float z, bool faces_camera) {
  TriangleMesh mesh{{{-2, -2, z}, {-2, 2, z}, {2, -2, z}, {2, 2, z}}, {{0, 1, 2}, {2, 1, 3}}};
  if (!faces_camera)
    for (auto& f : mesh.face) std::swap(f[1], f[2]);
  return mesh;
}

TriangleMesh both(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.position.size());
  a.position.insert(a.position.end(), b.position.begin(), b.position.end());
  for (auto f : b.face) a.face.push_back({f[0] + first, f[1] + first, f[2] + first});
  return a;
}

std::shared_ptr<const PpmMap> wave_map() {
  PpmSettings settings;
  settings.cell_size_m = 0.5;
  return make_map(height_field(30, 2.f, [](float x, float y) { return 1.5f + 0.2f * std::sin(3 * x + y); }), settings,
                  [](const Eigen::Vector3f& p) { return 0.01f * p.x() + 0.02f * p.y(); });
}

}  // namespace

TEST_CASE("prediction.embree gives range, texel, normal, face and barycentrics of each hit") {
  const auto map = wave_map();
  const std::string texel = GENERATE("nearest", "linear");
  const auto p = predictions("{texel: " + texel + "}", {map}, 2)[1];
  const double tolerance = texel == "linear" ? 1e-5 : 0.02 * 0.02;  // half a texel's width times the slope of the mean
  std::size_t hits = 0;
  for (std::size_t i = 0; i < p->range.size(); ++i) {
    if (!p->hit(i)) continue;
    ++hits;
    const Geometry& g = *map->table()[p->chunk[i]].geometry;
    const Eigen::Vector3d d = p->direction(i), at = p->T_map_camera.translation() + p->range[i] * d;
    const Eigen::Vector3f q = g.point(p->face[i], p->bary[2 * i], p->bary[2 * i + 1]);
    CHECK((at - q.cast<double>()).norm() < 1e-5);
    CHECK(p->mean[i] == Approx(0.01 * at.x() + 0.02 * at.y()).margin(tolerance));
    CHECK(p->variance[i] == Approx(1e-4));
    const Eigen::Vector3f n(p->normal[3 * i], p->normal[3 * i + 1], p->normal[3 * i + 2]);
    CHECK((n - g.face_normal(p->face[i])).norm() < 1e-3);
    CHECK(n.cast<double>().dot(d) < 0);
  }
  CHECK(hits == p->range.size());
}

TEST_CASE("back faces let the ray go on, or stop it with normal and mean turned") {
  const auto mean = [](const Eigen::Vector3f&) { return 0.03f; };
  const auto map = make_map(both(square(1.f, false), square(2.f, true)), {}, mean);
  const std::size_t centre = 19 * 50 + 25;
  const auto culled = predictions("{}", {map}, 1)[0];
  CHECK(culled->range[centre] * culled->direction(centre).z() == Approx(2.0 - 0.02).epsilon(1e-4));
  CHECK(culled->mean[centre] == Approx(0.03));
  const auto hit = predictions("{backfaces: hit}", {map}, 1)[0];
  CHECK(hit->range[centre] * hit->direction(centre).z() == Approx(1.0 - 0.02).epsilon(1e-4));
  CHECK(hit->mean[centre] == Approx(-0.03));
  CHECK(hit->normal[3 * centre + 2] == Approx(-1.0));
}

TEST_CASE("the same bytes come from any number of threads and again from the same module") {
  const auto a = wave_map();
  PpmEdit edit(a);
  edit.remove_face(0, 0);
  const auto b = edit.commit();
  const std::string one = bytes_of(predictions("{}", {a, b}, 8, 1));
  for (int threads : {1, 2, 4}) CHECK(bytes_of(predictions("{}", {a, b}, 8, threads)) == one);
}

TEST_CASE("an empty map and a camera that nearly touches a surface are no trouble") {
  const auto nothing = predictions("{}", {std::make_shared<const PpmMap>(PpmSettings{})}, 1)[0];
  for (std::size_t i = 0; i < nothing->range.size(); ++i) CHECK_FALSE(nothing->hit(i));
  // The square stands 2 cm in front of the first particle's centre, as near as a camera can be to a surface.
  const auto near = predictions("{}", {make_map(square(0.021f, true))}, 1)[0];
  CHECK(near->hit(19 * 50 + 25));
}

TEST_CASE("prediction.embree refuses packets that Embree does not know") {
  const Registry registry = builtin();
  CHECK_THROWS_AS(Harness(registry, "prediction.embree", "{packet: 5}"), ConfigError);
  CHECK_THROWS_AS(Harness(registry, "prediction.embree", "{backfaces: maybe}"), ConfigError);
}

TEST_CASE("rays through the compared pixels alone find what the image shows, whatever the packet") {
  const auto map = make_map(height_field(12, 2.f, [](float x, float y) { return 1.5f + 0.2f * std::sin(3 * x + y); }));
  const std::string image = bytes_of(predictions("{}", {map}, 3));
  for (const std::string packet : {"1", "4", "8", "16"})
    CHECK(bytes_of(predictions("{rays: compared, packet: " + packet + "}", {map}, 3, 2)) == image);
  // Few pixels out of order of the packets: each as in the whole view.
  const Registry registry = builtin();
  Harness h(registry, "prediction.embree", "{rays: compared}");
  h.input<Frame>("frame", frame_of(kCamera));
  h.belief().init(1, Pose::Identity(), map);
  h.tick();
  const auto& view = *h.belief().prediction[0];
  std::vector<std::uint32_t> all(static_cast<std::size_t>(kCamera.pixels())), some;
  std::iota(all.begin(), all.end(), 0u);
  for (std::uint32_t p = 3; p < all.size(); p += 5 + p % 7) some.push_back(p);
  ViewSamples of_all, of_some;
  of_all.resize(all.size());
  of_some.resize(some.size());
  view.sample(all, of_all);
  view.sample(some, of_some);
  for (std::size_t i = 0; i < some.size(); ++i) {
    CHECK(of_some.range[i] == of_all.range[some[i]]);
    CHECK(of_some.variance[i] == of_all.variance[some[i]]);
  }
}
