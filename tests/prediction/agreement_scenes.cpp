#include "tests/prediction/agreement_scenes.hpp"

#include <atomic>
#include <cmath>

#include "framework/graph/executor.hpp"
#include "modules/maps/ppm/meshed_room.hpp"
#include "tests/support/data.hpp"
#include "tests/support/mesh_map.hpp"
#include "tests/support/registry.hpp"

namespace ppm::test {
namespace {

const Camera kNormal{80, 61, 70, 72, 39.3, 30.2};  // sides that no packet divides
const Camera kFlipped{64, 48, 52, -50, 31.5, 23.5};
const Camera kWide{73, 55, 14, 13, 36.1, 27.4};  // 138 x 129 degrees
const Camera kLong{61, 45, 900, 880, 30, 22};    // 4 x 3 degrees
const Camera kTiny{3, 2, 2.5, 2.5, 1, 0.5};

/// Every kind of camera at one pose.
std::vector<Look> looks_from(const Pose& pose) {
  return {{kNormal, 1, pose}, {kFlipped, 1, pose}, {kWide, 1, pose},
          {kLong, 1, pose},   {kTiny, 1, pose},    {{176, 144, 150, 150, 87.5, 71.5}, 3, pose}};
}

Pose pose_of(double x, double y, double z, double rx, double ry, double rz) {
  Pose pose = se3_exp((Twist() << 0, 0, 0, rx, ry, rz).finished());
  pose.translation() << x, y, z;
  return pose;
}

PpmSettings cells_of(double size_m) {
  PpmSettings settings;
  settings.cell_size_m = size_m;
  return settings;
}

float tilted_mean(const Eigen::Vector3f& p) {
  return 0.004f * p.x() - 0.006f * p.y() + 0.002f * p.z();
}

Scene wave() {
  const auto mesh =
      height_field(24, 3.f, [](float x, float y) { return 2.f + 0.3f * std::sin(3 * x) * std::cos(2 * y); });
  Scene scene{"wave", make_map(mesh, cells_of(0.5), tilted_mean),
              looks_from(pose_of(0.013, -0.021, 0.1, 0.02, -0.01, 0.03))};
  for (const Look& look : looks_from(pose_of(0, 0, 3, 0, M_PI, 0)))
    scene.looks.push_back(look);                                            // from behind: nothing
  scene.looks.push_back({kNormal, 1, pose_of(-2.5, 0.2, 1.9, 0, 1.4, 0)});  // along the surface
  return scene;
}

/// Squares of 4 pixels at 1 m: rays go through vertices and along edges and diagonals.
Scene on_the_rays() {
  const Camera camera{48, 32, 32, 32, 24, 16};
  const auto mesh = height_field(16, 1.f, [](float, float) { return 1.f; });
  return {
      "vertices and edges on rays", make_map(mesh, cells_of(0.25), tilted_mean), {{camera, 1, Pose::Identity()}}, 0.5};
}

Scene room() {
  Scene scene{"room with boxes", map_of(meshed_room(6000), cells_of(1), tilted_mean, 1e-4f), {}};
  for (double angle : {0.1, 1.7, 3.9})
    for (const Look& look : looks_from(room_view(angle))) scene.looks.push_back(look);
  scene.looks.push_back({{176, 144, 150, 150, 87.5, 71.5}, 1, room_view(5.0)});
  return scene;
}

/// A soup made triangle by triangle: `triangle` gives the corners.
template <class Triangle>
TriangleMesh soup_of(int n, std::uint64_t seed, Triangle triangle) {
  Rng rng(seed, 0, 0, purpose_key("soup"));
  auto point = [&](double r) {
    const double x = rng.normal(), y = rng.normal(), z = rng.normal();
    return Eigen::Vector3f(r * Eigen::Vector3d(x, y, z).cast<float>());
  };
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i) {
    const auto corners = triangle(point);
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    mesh.position.insert(mesh.position.end(), corners.begin(), corners.end());
    mesh.face.push_back({first, first + 1, first + 2});
  }
  return mesh;
}
using Corners = std::array<Eigen::Vector3f, 3>;

TriangleMesh needles(std::uint64_t seed) {
  return soup_of(1500, seed, [](auto point) {
    const Eigen::Vector3f a = point(1.5), e = point(1.0);
    return Corners{a, a + e, a + 0.5f * e + point(0.006)};
  });
}

/// Planes that pass the origin at about a millimetre.
TriangleMesh grazing(std::uint64_t seed) {
  return soup_of(600, seed, [](auto point) {
    const Eigen::Vector3f a = point(1.5), b = point(1.5);
    return Corners{a, b, 2.f * point(1.0).normalized().dot(a) * a + b + point(0.001)};
  });
}

TriangleMesh about_the_camera(std::uint64_t seed) {
  return soup_of(500, seed, [](auto point) {
    const Eigen::Vector3f a = point(0.15);
    return Corners{a, a + point(0.1), a + point(0.1)};
  });
}

TriangleMesh huge(std::uint64_t seed) {
  return soup_of(40, seed, [](auto point) {
    const Eigen::Vector3f a = point(4.0);
    return Corners{a, a + point(100.0), a + point(100.0)};
  });
}

Scene soup(const std::string& name, const std::function<TriangleMesh(std::uint64_t)>& make, std::uint64_t seed,
           double cell_m) {
  Rng rng(seed, 0, 0, purpose_key("pose"));
  Twist xi;
  for (int i = 0; i < 6; ++i) xi[i] = (i < 3 ? 0.002 : 2.0) * rng.normal();
  auto settings = cells_of(cell_m);
  settings.texel_size_m = 0.05;
  return {name, make_map(make(seed), settings, tilted_mean), looks_from(se3_exp(xi))};
}

/// The map of the best particle after some frames of a graph.
std::shared_ptr<const PpmMap> map_after(const std::string& source, const std::string& color, std::int64_t frames,
                                        std::vector<Look>& looks) {
  const auto text = fmt::format(R"(name: mapped
seed: 1
nodes:
  - {{name: camera, {}}}
  - {{name: init, module: map.ppm_empty, in: {{frame: camera.frame}}, when: {{until_frame: 0}}, params: {{particles: 1, color: {}}}}}
  - {{name: motion, module: motion.reference_pose, in: {{frame: camera.frame}}, when: {{from_frame: 1}}}}
  - {{name: look, module: prediction.embree, in: {{frame: camera.frame}}}}
  - {{name: update, module: map_update.ppm_bayes, in: {{frame: camera.frame}}}}
)",
                                source, color);
  Graph graph = Graph::build(parse_yaml(text, "the test's graph"), builtin());
  const Workers workers(1);
  Log log(LogLevel::warning);
  Metrics metrics;
  Context context(workers, log, metrics, graph.seed(), {});
  Executor executor(graph, context);
  const std::atomic<bool> stop{false};
  executor.run(frames, stop);
  const auto& belief = executor.belief();
  const auto path = belief.trajectory[0].poses();
  for (const auto& at : {path.front(), path.back()})
    for (const Look& look : looks_from(at.T_map_camera * pose_of(0.01, -0.02, 0.005, 0.01, 0.02, -0.01)))
      looks.push_back(look);
  return std::static_pointer_cast<const PpmMap>(belief.map[0]);
}

}  // namespace

std::vector<Scene> shaped_scenes() {
  return {wave(), on_the_rays(), room()};
}

std::vector<Scene> soups() {
  std::vector<Scene> scenes;
  const auto mixed = [](std::uint64_t seed) { return triangle_soup(500, seed); };
  for (std::uint64_t seed : {1, 2, 3, 4}) {
    scenes.push_back(soup("mixed soup", mixed, seed, 4));
    scenes.push_back(soup("needles", needles, seed, 1));
    scenes.push_back(soup("grazing planes", grazing, seed, 2));
    scenes.push_back(soup("about the camera", about_the_camera, seed, 0.25));
    scenes.push_back(soup("huge walls", huge, seed, 10));
  }
  return scenes;
}

Scene mapped_room() {
  Scene scene{"mapped room, in colour", nullptr, {}};
  scene.map =
      map_after("module: source.synthetic_room, params: {frames: 12, stride: 3, color: true}", "rgb", 4, scene.looks);
  return scene;
}

std::optional<Scene> mapped_kitchen() {
  const auto kitchen = data_path("kitchen");
  if (!kitchen) return std::nullopt;
  Scene scene{"mapped kitchen", nullptr, {}};
  const auto source = fmt::format("module: source.seven_scenes, params: {{path: \"{}\", pixel_stride: 2, stride: 5}}",
                                  kitchen->string());
  scene.map = map_after(source, "none", 8, scene.looks);
  return scene;
}

}  // namespace ppm::test
