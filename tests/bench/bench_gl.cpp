// What views of a mesh map cost by OpenGL, by how many are drawn together: docs/views_gl.md. With Mesa's llvmpipe the
// environment's LP_NUM_THREADS says how many threads draw (0: the caller's).
#include <benchmark/benchmark.h>
#include <map>
#include <memory>
#include <vector>

#include "framework/core/error.hpp"
#include "framework/core/rng.hpp"
#include "modules/maps/ppm/meshed_room.hpp"
#include "modules/maps/ppm/visible_chunks.hpp"
#include "modules/prediction/gl_views.hpp"

using namespace ppm;

namespace {

const Camera kCamera{176, 144, 150, 150, 87.5, 71.5};

// The meshed room, cut into cells of 1 m.
std::shared_ptr<const PpmMap> room(int faces) {
  static std::map<int, std::shared_ptr<const PpmMap>> made;
  auto& map = made[faces];
  if (!map)
    map = map_of(
        meshed_room(faces), {}, [](const Eigen::Vector3f&) { return 0.f; }, 1e-4f);
  return map;
}

// Looks across the room.
Pose look() {
  const Eigen::Vector3d forward = Eigen::Vector3d(0.6, 0.78, -0.2).normalized();
  Pose pose = Pose::Identity();
  pose.translation() << 3.6, 3.3, 1.5;
  Eigen::Matrix3d R;
  R.col(2) = forward;
  R.col(0) = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  R.col(1) = forward.cross(R.col(0));
  pose.linear() = R;
  return pose;
}

// Views of one map around one pose, as the particles of a filter look at it.
std::vector<GlView> views_of(const PpmMap& map, int n) {
  Rng rng(7, 0, 0, 0);
  std::vector<GlView> views;
  for (int i = 0; i < n; ++i) {
    Twist jitter;
    for (int k = 0; k < 6; ++k) jitter[k] = (k < 3 ? 0.02 : 0.017) * rng.normal();
    views.push_back({&map, nullptr, look() * se3_exp(jitter)});
  }
  return views;
}

void report(benchmark::State& state, int views) {
  state.counters["views"] = views;
}

// Draws and reads back `range(1)` views, range(2) a draw.
void draw(benchmark::State& state) {
  const auto map = room(static_cast<int>(state.range(0)));
  const auto n = static_cast<int>(state.range(1));
  GlViews gl({.views_per_draw = static_cast<int>(state.range(2))});
  gl.update({map.get()});
  const auto views = views_of(*map, n);
  for (auto _ : state) {
    gl.expect(kCamera, views);
    for (const auto& view : views) benchmark::DoNotOptimize(gl.faces(*map, kCamera, view.T_map_camera).number.data());
  }
  report(state, n);
}

// The part of it that is no drawing: clearing and reading back `range(0)` views.
void clear_and_read(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  const GlContext context(GlDevice::any);
  const GlContext::Current current(context);
  GlTarget target(context.gl());
  target.resize(kCamera.cols, kCamera.rows, n);
  std::vector<std::uint32_t> numbers(static_cast<std::size_t>(n) * static_cast<std::size_t>(kCamera.pixels()));
  for (auto _ : state) {
    target.start(n);
    target.read(n, numbers.data());
  }
  report(state, n);
}

// The processor's share before drawing: which chunks may be seen.
void cull(benchmark::State& state) {
  const auto map = room(static_cast<int>(state.range(0)));
  const auto views = views_of(*map, 10);
  std::size_t chunks = 0;
  for (auto _ : state)
    for (const auto& view : views) chunks = chunks_in_image(*map, kCamera, view.T_map_camera).size();
  report(state, 10);
  state.counters["chunks"] = static_cast<double>(chunks);
  state.counters["of"] = static_cast<double>(map->table().size());
}

// And after it: every `range(1)`-th pixel and row of a drawn view, as a likelihood asks for it.
void samples(benchmark::State& state) {
  const auto map = room(static_cast<int>(state.range(0)));
  const auto step = static_cast<int>(state.range(1));
  GlViews gl({});
  gl.update({map.get()});
  Prediction view;
  view.reset_deferred(kCamera, 1, views_of(*map, 1).front().T_map_camera);
  const FaceView faces(*map, true, gl.faces(*map, kCamera, view.T_map_camera));
  std::vector<std::uint32_t> pixels;
  for (int y = 0; y < kCamera.rows; y += step)
    for (int x = 0; x < kCamera.cols; x += step) pixels.push_back(static_cast<std::uint32_t>(y * kCamera.cols + x));
  ViewSamples out;
  out.resize(pixels.size());
  for (auto _ : state) {
    faces.sample(view, pixels, out);
    benchmark::DoNotOptimize(out.range.data());
  }
  report(state, 1);
}

void open(benchmark::State& state) {
  for (auto _ : state) GlViews gl({});
}

void register_all() {
  const auto add = [](const char* name, auto f) {
    return benchmark::RegisterBenchmark(name, f)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
  };
  for (int faces : {20000, 100000}) {
    add("cull", cull)->Arg(faces);
    add("samples", samples)->Args({faces, 1})->Args({faces, 4});
    for (int together : {1, 4, 10, 100}) add("draw", draw)->Args({faces, 100, together});
  }
  for (int views : {1, 4, 10, 100}) add("clear_and_read", clear_and_read)->Arg(views);
  add("open", open);
}

}  // namespace

int main(int argc, char** argv) {
  register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  try {
    fmt::print("{}\n", GlContext(GlDevice::any).renderer());
  } catch (const Error& error) {
    fmt::print("SKIPPED: {}\n", error.what());
    return 0;
  }
  benchmark::RunSpecifiedBenchmarks();
}
