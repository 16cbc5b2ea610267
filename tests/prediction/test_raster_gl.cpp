// prediction.raster_gl beside prediction.embree, and what is its own: batches, the device's memory, several at a time.
// What it sees is judged by an oracle in test_agreement.cpp.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <thread>

#include "framework/core/digest.hpp"
#include "framework/core/se3.hpp"
#include "framework/graph/harness.hpp"
#include "framework/roles/view_predictor.hpp"
#include "framework/slam/frame.hpp"
#include "modules/prediction/gl_views.hpp"
#include "tests/prediction/gl_device.hpp"
#include "tests/prediction/whole_views.hpp"
#include "tests/support/mesh_map.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

using Maps = std::vector<std::shared_ptr<const PpmMap>>;

const Camera kUpright{50, 38, 40, 40, 24.5, 18.5};
const Camera kRowsUp{50, 38, 40, -40, 24.5, 18.5};  // as ICL-NUIM has it

bool can_draw() {
  if (gl_lacks().empty()) return true;
  std::cout << "SKIPPED: " << gl_lacks() << "\n";
  return false;
}

// Particles around the origin that look at the maps in turn.
void set_particles(ParticleSet& belief, const Maps& maps, std::size_t n) {
  belief.init(n, Pose::Identity(), nullptr);
  for (std::size_t i = 0; i < n; ++i) {
    const double k = static_cast<double>(i);
    belief.pose[i] = se3_exp((Twist() << 0.01 * k, 0.003, 0.02, 0.002 * k, 0.01, 0.03 * k).finished());
    belief.map[i] = maps[i % maps.size()];
  }
}

std::shared_ptr<const Frame> frame_of(const Camera& camera) {
  auto frame = std::make_shared<Frame>();
  frame->camera = camera;
  return frame;
}

std::vector<PredictionHandle> views(const std::string& module, const std::string& params, const Maps& maps,
                                    std::size_t n, int threads = 1, const Camera& camera = kUpright) {
  Harness h(builtin(), module, params, threads);
  h.input<Frame>("frame", frame_of(camera));
  set_particles(h.belief(), maps, n);
  h.tick();
  return whole_views(h.belief());
}

std::string bytes_of(const std::vector<PredictionHandle>& all) {
  Digest digest;
  for (const auto& p : all)
    for (const auto* array : {&p->range, &p->mean, &p->variance, &p->normal, &p->bary, &p->color, &p->color_variance})
      digest.add(*array);
  for (const auto& p : all) {
    digest.add(p->chunk);
    digest.add(p->face);
  }
  return digest.hex();
}

std::shared_ptr<const PpmMap> wave_map(double cell_m = 0.5) {
  PpmSettings settings;
  settings.cell_size_m = cell_m;
  return make_map(height_field(30, 2.f, [](float x, float y) { return 1.5f + 0.2f * std::sin(3 * x + y); }), settings,
                  [](const Eigen::Vector3f& p) { return 0.01f * p.x() + 0.02f * p.y(); });
}

std::shared_ptr<const PpmMap> without_a_face(std::shared_ptr<const PpmMap> map, std::uint32_t c) {
  PpmEdit edit(std::move(map));
  edit.remove_face(c, 0);
  return edit.commit();
}

// Where both show the same face, all else must be the same; returns the share of such pixels.
double same_share(const Prediction& a, const Prediction& b) {
  std::size_t same = 0;
  double range = 0, mean = 0, normal = 0;
  for (std::size_t p = 0; p < a.range.size(); ++p) {
    if (a.chunk[p] != b.chunk[p] || a.face[p] != b.face[p]) continue;
    ++same;
    if (!a.hit(p)) continue;
    range = std::max<double>(range, std::abs(a.range[p] - b.range[p]));
    mean = std::max<double>(mean, std::abs(a.mean[p] - b.mean[p]));
    for (std::size_t k = 3 * p; k < 3 * p + 3; ++k)
      normal = std::max<double>(normal, std::abs(a.normal[k] - b.normal[k]));
  }
  CHECK(range < 2e-5);
  CHECK(mean < 2e-6);
  CHECK(normal < 1e-5);
  return static_cast<double>(same) / static_cast<double>(a.range.size());
}

}  // namespace

TEST_CASE("prediction.raster_gl sees what prediction.embree sees, but for pixels on edges") {
  if (!can_draw()) return;
  const Camera& camera = GENERATE(kUpright, kRowsUp);
  const std::string backfaces = GENERATE("cull", "hit"), texel = GENERATE("nearest", "linear");
  const auto params = "{stride: 2, backfaces: " + backfaces + ", texel: " + texel + "}";
  PpmSettings settings;
  settings.cell_size_m = 2;
  const Maps maps{wave_map(), make_map(triangle_soup(300, 3), settings)};
  const auto gl = views("prediction.raster_gl", params, maps, 6, 2, camera);
  const auto embree = views("prediction.embree", params, maps, 6, 2, camera);
  CAPTURE(params, camera.fy);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < gl.size(); ++i) {
    CHECK(gl[i]->camera == embree[i]->camera);
    CHECK(same_share(*gl[i], *embree[i]) > 0.995);
    for (std::size_t p = 0; p < gl[i]->range.size(); ++p) hits += gl[i]->hit(p);
  }
  CHECK(hits > 1500);
}

TEST_CASE("prediction.raster_gl gives the same bytes for any number of threads and of views in a draw") {
  if (!can_draw()) return;
  const auto a = wave_map();
  const Maps maps{a, without_a_face(a, 0), without_a_face(a, 5)};
  const std::string alone = bytes_of(views("prediction.raster_gl", "{views_per_draw: 1}", maps, 11));
  for (int threads : {1, 2, 4})
    for (const char* together : {"2", "4", "256"})
      CHECK(bytes_of(views("prediction.raster_gl", fmt::format("{{views_per_draw: {}}}", together), maps, 11,
                           threads)) == alone);
}

TEST_CASE("of two faces at the same place the lower one is seen") {
  if (!can_draw()) return;
  TriangleMesh twice{{{-2, -2, 2}, {-2, 2, 2}, {2, -2, 2}, {2, 2, 2}}, {{0, 1, 2}, {2, 1, 3}}};
  for (std::size_t i = 0; i < 4; ++i) twice.position.push_back(twice.position[i]);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto f = twice.face[i];
    twice.face.push_back({f[0] + 4, f[1] + 4, f[2] + 4});
  }
  PpmSettings settings;
  settings.cell_size_m = 10;
  for (const auto& view : views("prediction.raster_gl", "{}", {make_map(twice, settings)}, 3))
    CHECK(std::ranges::count(view->face, 0u) + std::ranges::count(view->face, 1u) ==
          static_cast<std::ptrdiff_t>(view->face.size()));
}

TEST_CASE("maps share triangles on the device, what no map uses any more makes room for others") {
  if (!can_draw()) return;
  GlViews gl({});
  auto map = wave_map(0.5);
  const auto child = without_a_face(map, 2);
  const auto filled = static_cast<std::size_t>(
      std::ranges::count_if(map->table().chunks(), [](const auto& c) { return !c.geometry->face.empty(); }));
  gl.update({map.get(), map.get()});
  CHECK(gl.meshes().size() == filled);
  gl.update({map.get(), child.get()});
  CHECK(gl.meshes().size() == filled + gl.meshes().added());
  CHECK(gl.meshes().added() < filled / 4);
  const auto bytes = gl.meshes().bytes();
  for (std::uint32_t i = 0; i < 40; ++i) {
    map = without_a_face(std::move(map), i % 20);
    gl.update({map.get()});
  }
  CHECK(gl.meshes().bytes() == bytes);
  // Moved to larger memory, the triangles are still the same.
  const auto large = make_map(height_field(200, 2.f, [](float x, float y) { return 1.5f + 0.1f * x * y; }));
  const auto look = [&](const std::vector<const PpmMap*>& maps) {
    gl.update(maps);
    return *gl.faces(*map, kUpright, Pose::Identity()).drawn;
  };
  const auto before = look({map.get()});
  CHECK(look({map.get(), large.get()}) == before);
  CHECK(gl.meshes().bytes() > bytes);
}

TEST_CASE("a view that nobody announced is drawn all the same") {
  if (!can_draw()) return;
  const auto map = wave_map();
  Harness h(builtin(), "prediction.raster_gl", "{}");
  h.input<Frame>("frame", frame_of(kUpright));
  set_particles(h.belief(), {map}, 3);
  h.tick();
  const auto announced = whole_views(h.belief());
  h.close();  // as held-out frames are predicted after the run
  auto& predictor = dynamic_cast<ViewPredictor&>(h.module());
  predictor.prepare({map.get()}, h.context().workers());
  Prediction out;
  out.reset(kUpright, 1, h.belief().pose[2]);
  predictor.predict_all(*map, out, 0);
  CHECK(out.range == announced[2]->range);
  CHECK(out.face == announced[2]->face);
  const PpmMap unknown{PpmSettings{}};
  CHECK_THROWS_AS(predictor.predict_all(unknown, out, 0), InternalError);
}

TEST_CASE("an empty map, and a map behind the camera, are no trouble") {
  if (!can_draw()) return;
  const auto behind = make_map(height_field(4, 1.f, [](float, float) { return -1.f; }));
  for (const auto& map : {std::make_shared<const PpmMap>(PpmSettings{}), behind})
    for (const auto& view : views("prediction.raster_gl", "{}", {map}, 3))
      CHECK(std::ranges::all_of(view->chunk, [](auto c) { return c == Prediction::kNone; }));
}

TEST_CASE("two nodes draw at the same time, each as if it were alone") {
  if (!can_draw()) return;
  const auto map = wave_map();
  const std::string alone = bytes_of(views("prediction.raster_gl", "{}", {map}, 8, 2));
  std::string bytes[2];
  {
    std::vector<std::jthread> nodes;
    for (auto& own : bytes)
      nodes.emplace_back([&] { own = bytes_of(views("prediction.raster_gl", "{}", {map}, 8, 2)); });
  }
  CHECK(bytes[0] == alone);
  CHECK(bytes[1] == alone);
}

TEST_CASE("prediction.raster_gl says which device it lacks, and refuses what it does not know") {
  CHECK_THROWS_AS(Harness(builtin(), "prediction.raster_gl", "{device: voodoo}"), ConfigError);
  CHECK_THROWS_AS(Harness(builtin(), "prediction.raster_gl", "{views_per_draw: 257}"), ConfigError);
  try {
    const GlContext context(GlDevice::hardware);
    CHECK_FALSE(context.renderer().empty());
  } catch (const Error& error) {
    CHECK_THAT(error.what(), Catch::StartsWith("no hardware device for OpenGL without a display"));
  }
}
