// What a view of a mesh map costs, by drawing and by ray casting, in one run: docs/views.md.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <map>
#include <numeric>
#include <span>

#include "modules/maps/ppm/meshed_room.hpp"
#include "modules/prediction/embree_scenes.hpp"
#include "modules/prediction/embree_view.hpp"
#include "modules/prediction/raster_drawing.hpp"

using namespace ppm;

namespace {

const Camera kCamera{176, 144, 150, 150, 87.5, 71.5};

std::shared_ptr<const PpmMap> room(int faces) {
  static std::map<int, std::shared_ptr<const PpmMap>> made;
  auto& map = made[faces];
  if (!map)
    map = map_of(
        meshed_room(faces), {}, [](const Eigen::Vector3f&) { return 0.f; }, 1e-4f);
  return map;
}

/// A back-end as the filter uses it: draw() what each pixel shows, then sample() or complete.
struct Raster {
  explicit Raster(std::shared_ptr<const PpmMap> m) : map(std::move(m)) {}
  void draw(Prediction& out) {
    auto view = views.take();
    view->start(*map, out, {});
    draw_rows(all_rows(out.camera), *view, scratch);
    out.deferred = view;
  }
  std::shared_ptr<const PpmMap> map;
  Pool<RasterView> views;
  RasterScratch scratch;
};

struct Embree {
  explicit Embree(std::shared_ptr<const PpmMap> m) : map(std::move(m)), scenes({}) {
    scenes.update({map.get()}, Workers(1));
  }
  void draw(Prediction& out) {
    auto view = views.take();
    view->start(*map, true, static_cast<std::size_t>(out.camera.pixels()));
    trace_hits(*map, scenes.of(*map), {}, all_rows(out.camera), out, view->hits());
    out.deferred = view;
  }
  std::shared_ptr<const PpmMap> map;
  EmbreeScenes scenes;
  Pool<ElementView> views;
};

enum class Ask { nothing, samples, arrays };

// range(0): faces; range(1): stride.
template <class BackEnd>
void view(benchmark::State& state, Ask ask) {
  BackEnd back_end(room(static_cast<int>(state.range(0))));
  Prediction out, whole;
  ViewSamples samples;
  std::vector<std::uint32_t> pixels;
  int i = 0;
  for (auto _ : state) {
    out.reset_deferred(kCamera, static_cast<int>(state.range(1)), room_view(0.3 * (i++ % 20)));
    back_end.draw(out);
    if (ask == Ask::samples) {
      pixels.resize(static_cast<std::size_t>(out.camera.pixels()));
      std::iota(pixels.begin(), pixels.end(), 0u);
      for (std::size_t first = 0; first < pixels.size(); first += samples.size()) {
        samples.resize(std::min<std::size_t>(1024, pixels.size() - first));
        out.sample(std::span(pixels).subspan(first, samples.size()), samples);
        benchmark::DoNotOptimize(samples.range.data());
      }
    } else if (ask == Ask::arrays) {
      whole.reset(out.camera, 1, out.T_map_camera);
      out.deferred->fill(out, all_rows(out.camera), whole);
      benchmark::DoNotOptimize(whole.range.data());
    }
  }
  state.counters["Mpixel/s"] = benchmark::Counter(1e-6 * out.camera.pixels() * static_cast<double>(state.iterations()),
                                                  benchmark::Counter::kIsRate);
}

template <class BackEnd>
void register_back_end(const std::string& name) {
  for (auto [asked, ask] : {std::pair{"hits", Ask::nothing}, {"samples", Ask::samples}, {"arrays", Ask::arrays}}) {
    auto* bench = benchmark::RegisterBenchmark((name + "/" + asked).c_str(),
                                               [a = ask](benchmark::State& state) { view<BackEnd>(state, a); });
    bench->Unit(benchmark::kMicrosecond)->ArgNames({"faces", "stride"});
    for (int faces : {20000, 100000, 500000})
      for (int stride : {1, 4}) bench->Args({faces, stride});
  }
}

}  // namespace

int main(int argc, char** argv) {
  register_back_end<Raster>("raster");
  register_back_end<Embree>("embree");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
