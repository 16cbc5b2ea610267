// What a view of a mesh map costs by ray casting, and what the acceleration structures cost:
// docs/results/embree_scenes.md.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>
#include <map>
#include <memory>
#include <vector>

#include "modules/maps/ppm/meshed_room.hpp"
#include "modules/prediction/embree_scenes.hpp"
#include "modules/prediction/embree_view.hpp"

using namespace ppm;

namespace {

const Camera kCamera{176, 144, 150, 150, 87.5, 71.5};

// The meshed room, cut into cells of `cell_m`.
std::shared_ptr<const PpmMap> room(int faces, double cell_m) {
  static std::map<std::pair<int, double>, std::shared_ptr<const PpmMap>> made;
  auto& map = made[{faces, cell_m}];
  if (map) return map;
  PpmSettings settings;
  settings.cell_size_m = cell_m;
  return map = map_of(meshed_room(faces), settings, [](const Eigen::Vector3f&) { return 0.f; }, 1e-4f);
}

Pose pose(int i) {
  return room_view(0.3 * i);
}

void report(benchmark::State& state, std::size_t hits) {
  state.counters["Mray/s"] = benchmark::Counter(1e-6 * kCamera.pixels() * static_cast<double>(state.iterations()),
                                                benchmark::Counter::kIsRate);
  state.counters["hit"] = static_cast<double>(hits) / kCamera.pixels();
}

// Own traversal of the chunks' scenes: what prediction.embree does, hits and texels read.
void view(benchmark::State& state, EmbreeViewOptions options, EmbreeOptions scene, double cell_m) {
  const auto map = room(static_cast<int>(state.range(0)), cell_m);
  const Workers workers(1);
  EmbreeScenes scenes(scene);
  scenes.update({map.get()}, workers);
  Prediction out;
  int i = 0;
  for (auto _ : state) {
    out.reset(kCamera, 1, pose(i++ % 20));
    trace_view(*map, scenes.of(*map), options, all_rows(out.camera), out);
    benchmark::DoNotOptimize(out.range.data());
  }
  std::size_t hits = 0;
  for (std::size_t p = 0; p < out.range.size(); ++p) hits += out.hit(p);
  report(state, hits);
  state.counters["chunks"] = static_cast<double>(map->table().size());
  state.counters["MB"] = static_cast<double>(scenes.bytes()) / 1e6;
}

// Hits alone, attributes deferred: what a node costs whose view is compared at few pixels.
void hits(benchmark::State& state, double cell_m) {
  const auto map = room(static_cast<int>(state.range(0)), cell_m);
  const Workers workers(1);
  EmbreeScenes scenes({});
  scenes.update({map.get()}, workers);
  Prediction view;
  ElementView found;
  int i = 0;
  for (auto _ : state) {
    view.reset_deferred(kCamera, 1, pose(i++ % 20));
    found.start(*map, true, static_cast<std::size_t>(kCamera.pixels()));
    trace_hits(*map, scenes.of(*map), {}, all_rows(kCamera), view, found.hits());
    benchmark::DoNotOptimize(found.hits().range.data());
  }
  const auto& chunk = found.hits().chunk;
  report(state, chunk.size() - static_cast<std::size_t>(std::count(chunk.begin(), chunk.end(), Prediction::kNone)));
}

// Samples of some pixels on a regular grid, by rays through those alone or by a view of the whole image.
void samples(benchmark::State& state, bool compared_alone) {
  const auto map = room(static_cast<int>(state.range(0)), 1.0);
  const Workers workers(1);
  EmbreeScenes scenes({});
  scenes.update({map.get()}, workers);
  const int step = static_cast<int>(state.range(1));
  std::vector<std::uint32_t> pixels;
  for (int y = 0; y < kCamera.rows; y += step)
    for (int x = 0; x < kCamera.cols; x += step) pixels.push_back(static_cast<std::uint32_t>(y * kCamera.cols + x));
  Prediction view;
  EmbreeRays rays;
  ElementView image;
  ViewSamples out;
  out.resize(pixels.size());
  int i = 0;
  for (auto _ : state) {
    view.reset_deferred(kCamera, 1, pose(i++ % 20));
    if (compared_alone) {
      rays.start(*map, scenes.of(*map), {}, view);
      rays.sample(view, pixels, out);
    } else {
      image.start(*map, true, static_cast<std::size_t>(kCamera.pixels()));
      trace_hits(*map, scenes.of(*map), {}, all_rows(kCamera), view, image.hits());
      image.sample(view, pixels, out);
    }
    benchmark::DoNotOptimize(out.range.data());
  }
  state.counters["pixels"] = static_cast<double>(pixels.size());
}

// The alternative: one scene of instances of the chunks' scenes for each map. Ranges and ids only, no texels.
class InstanceScene {
 public:
  InstanceScene(RTCDevice device, const std::vector<std::unique_ptr<EmbreeScene>>& chunks)
      : scene_(rtcNewScene(device)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      if (!chunks[i]) continue;
      RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(instance, chunks[i]->handle());
      rtcCommitGeometry(instance);
      rtcAttachGeometryByID(scene_, instance, static_cast<unsigned>(i));
      rtcReleaseGeometry(instance);
    }
    rtcCommitScene(scene_);
  }
  InstanceScene(const InstanceScene&) = delete;
  InstanceScene& operator=(const InstanceScene&) = delete;
  ~InstanceScene() { rtcReleaseScene(scene_); }

  void trace(Prediction& out) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) int valid[16];
    std::fill(valid, valid + 16, -1);
    RTCRayHit16 r;
    const Eigen::Vector3f o = out.T_map_camera.translation().cast<float>();
    const Eigen::Matrix3f R = out.T_map_camera.linear().cast<float>();
    for (int y = 0; y < kCamera.rows; y += 4)
      for (int x = 0; x < kCamera.cols; x += 4) {
        for (int i = 0; i < 16; ++i) {
          const Eigen::Vector3f d = (R * kCamera.ray(x + i % 4, y + i / 4).cast<float>()).normalized();
          r.ray.org_x[i] = o.x(), r.ray.org_y[i] = o.y(), r.ray.org_z[i] = o.z();
          r.ray.dir_x[i] = d.x(), r.ray.dir_y[i] = d.y(), r.ray.dir_z[i] = d.z();
          r.ray.tnear[i] = r.ray.time[i] = 0;
          r.ray.tfar[i] = Prediction::kMiss;
          r.ray.mask[i] = 0xffffffffu;
          r.ray.id[i] = r.ray.flags[i] = 0;
          r.hit.geomID[i] = r.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(valid, scene_, &context, &r);
        for (int i = 0; i < 16; ++i) {
          const auto p = static_cast<std::size_t>((y + i / 4) * kCamera.cols + x + i % 4);
          out.range[p] = r.ray.tfar[i];
          out.chunk[p] = r.hit.instID[0][i];
          out.face[p] = r.hit.primID[i];
        }
      }
  }

 private:
  RTCScene scene_;
};

std::vector<std::unique_ptr<EmbreeScene>> chunk_scenes(const EmbreeDevice& device, const PpmMap& map) {
  std::vector<std::unique_ptr<EmbreeScene>> scenes;
  for (const auto& chunk : map.table().chunks())
    scenes.push_back(chunk.geometry->face.empty() ? nullptr : std::make_unique<EmbreeScene>(device, *chunk.geometry));
  return scenes;
}

void instanced_view(benchmark::State& state, double cell_m) {
  const auto map = room(static_cast<int>(state.range(0)), cell_m);
  const EmbreeDevice device({});
  const auto chunks = chunk_scenes(device, *map);
  const InstanceScene top(device.handle(), chunks);
  Prediction out;
  int i = 0;
  for (auto _ : state) {
    out.reset(kCamera, 1, pose(i++ % 20));
    top.trace(out);
    benchmark::DoNotOptimize(out.range.data());
  }
  std::size_t hits = 0;
  for (std::size_t p = 0; p < out.range.size(); ++p) hits += out.hit(p);
  report(state, hits);
}

void instance_build(benchmark::State& state, double cell_m) {
  const auto map = room(static_cast<int>(state.range(0)), cell_m);
  const EmbreeDevice device({});
  const auto chunks = chunk_scenes(device, *map);
  for (auto _ : state) InstanceScene top(device.handle(), chunks);
}

// Builds every chunk's scene. range(1): threads.
void build(benchmark::State& state, EmbreeOptions::Build quality) {
  const auto map = room(static_cast<int>(state.range(0)), 1.0);
  const Workers workers(static_cast<int>(state.range(1)));
  EmbreeOptions options;
  options.build = quality;
  EmbreeScenes scenes(options);
  for (auto _ : state) {
    scenes.update({}, workers);
    scenes.update({map.get()}, workers);
  }
  state.counters["us/chunk"] = benchmark::Counter(1e-6 * static_cast<double>(state.iterations() * scenes.size()),
                                                  benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// What update() costs when nothing is new: `range(1)` maps that share all chunks.
void nothing_new(benchmark::State& state) {
  const auto map = room(static_cast<int>(state.range(0)), 1.0);
  const Workers workers(1);
  std::vector<std::shared_ptr<const PpmMap>> copies;
  std::vector<const PpmMap*> maps;
  for (int i = 0; i < state.range(1); ++i)
    maps.push_back(copies.emplace_back(std::make_shared<const PpmMap>(*map)).get());
  EmbreeScenes scenes({});
  for (auto _ : state) scenes.update(maps, workers);
}

void register_all() {
  using benchmark::RegisterBenchmark;
  auto add = [](const std::string& name, auto f) {
    return RegisterBenchmark(name.c_str(), f)->Unit(benchmark::kMillisecond)->UseRealTime();
  };
  auto add_view = [&](const std::string& name, EmbreeViewOptions v, EmbreeOptions s, double cell) {
    add(name, [=](benchmark::State& st) { view(st, v, s, cell); })->Arg(20000)->Arg(100000);
  };
  using Build = EmbreeOptions::Build;
  for (int packet : {1, 4, 8, 16}) add_view("chunks_1m/packet:" + std::to_string(packet), {.packet = packet}, {}, 1.0);
  add("chunks_1m/hits_alone", [](benchmark::State& st) { hits(st, 1.0); })->Arg(20000)->Arg(100000);
  for (bool alone : {true, false})
    add(alone ? "samples/compared_alone" : "samples/of_image", [=](benchmark::State& st) { samples(st, alone); })
        ->ArgsProduct({{20000, 100000}, {1, 2, 5, 10, 20}});
  add_view("chunks_1m/incoherent", {.coherent = false}, {}, 1.0);
  add_view("chunks_1m/nearest_texels", {.linear_texels = false}, {}, 1.0);
  add_view("chunks_1m/fast_test", {}, {.robust = false}, 1.0);
  add_view("chunks_1m/backfaces_hit", {.cull_back_faces = false}, {}, 1.0);
  add_view("chunks_1m/build_low", {}, {.build = Build::low}, 1.0);
  add_view("chunks_1m/build_high", {}, {.build = Build::high}, 1.0);
  for (double cell : {0.5, 2.0, 50.0}) add_view("chunks_" + std::to_string(cell).substr(0, 4) + "m", {}, {}, cell);
  for (double cell : {0.5, 1.0, 50.0}) {
    const std::string m = std::to_string(cell).substr(0, 3) + "m";
    add("instances_" + m, [=](benchmark::State& st) { instanced_view(st, cell); })->Arg(20000)->Arg(100000);
    add("instances_build_" + m, [=](benchmark::State& st) { instance_build(st, cell); })->Arg(20000)->Arg(100000);
  }
  for (auto [name, quality] : {std::pair{"low", Build::low}, {"medium", Build::medium}, {"high", Build::high}})
    add(std::string("build/") + name, [q = quality](benchmark::State& st) { build(st, q); })
        ->Args({100000, 1})
        ->Args({100000, 2});
  add("update_nothing_new", nothing_new)->Args({100000, 1})->Args({100000, 100});
}

}  // namespace

int main(int argc, char** argv) {
  register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
