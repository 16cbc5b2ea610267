// What writing a frame into a particle's mesh costs, one thread: docs/results/map_update_speed.md. A meshed room seen
// by 176x144 pixels that the map explains, so that there is no new surface. Arguments: triangles, texel size in mm,
// cell size in cm. Particles have texels of their own, more than caches hold.
#include <benchmark/benchmark.h>

#include "modules/maps/ppm/meshed_room.hpp"
#include "modules/maps/ppm/ppm_update.hpp"
#include "modules/prediction/embree_scenes.hpp"
#include "modules/prediction/embree_view.hpp"
#include "tests/map_update/gather_reference.hpp"
#include "tests/support/workers.hpp"

namespace {

using namespace ppm;
using MapPtr = std::shared_ptr<const PpmMap>;

const Camera kCamera{176, 144, 150, 150, 87.5, 71.5};

MapPtr room(const benchmark::State& state) {
  static std::map<std::array<std::int64_t, 3>, MapPtr> made;
  auto& map = made[{state.range(0), state.range(1), state.range(2)}];
  if (map) return map;
  PpmSettings settings;
  settings.texel_size_m = 1e-3 * static_cast<double>(state.range(1));
  settings.cell_size_m = 1e-2 * static_cast<double>(state.range(2));
  return map = map_of(
             meshed_room(static_cast<int>(state.range(0))), settings, [](const Eigen::Vector3f&) { return 0.f; },
             1e-4f);
}

/// The map with no texels shared.
MapPtr with_own_texels(const MapPtr& map) {
  PpmEdit edit(map);
  for (std::uint32_t c = 0; c < map->table().size(); ++c) edit.texels(c);
  return edit.commit();
}

/// A place to look from: the view of the room there and an image that agrees with it, but for up to 4 mm.
struct Place {
  PredictionHandle view, whole;
  Frame frame;
  VisibleFaces seen;
};

std::vector<Place> places(const MapPtr& map) {
  EmbreeScenes scenes({});
  scenes.update({map.get()}, test::one_worker());
  std::vector<Place> all(20);
  PredictionPool pool;
  for (std::size_t i = 0; i < all.size(); ++i) {
    auto view = std::make_shared<Prediction>();
    view->reset_deferred(kCamera, 1, room_view(0.3 * static_cast<double>(i)));
    auto record = std::make_shared<ElementView>();
    record->start(*map, true, static_cast<std::size_t>(kCamera.pixels()));
    trace_hits(*map, scenes.of(*map), {}, all_rows(kCamera), *view, record->hits());
    view->deferred = record;
    all[i].view = view;
    all[i].whole = completed(view, pool, test::one_worker());
    Frame& frame = all[i].frame;
    frame.camera = kCamera;
    for (int p = 0; p < kCamera.pixels(); ++p) {
      const float range = all[i].whole->range[static_cast<std::size_t>(p)];
      const auto along = static_cast<float>(kCamera.ray(p % kCamera.cols, p / kCamera.cols).norm());
      frame.depth.push_back(range < 100 ? range / along + 0.004f * std::sin(static_cast<float>(p)) : NAN);
      frame.sigma.push_back(0.005f);
    }
    all[i].seen.collect(*map, *view, frame);
  }
  return all;
}

/// Maps, each with texels of its own.
std::vector<MapPtr> particles(const MapPtr& map) {
  std::vector<MapPtr> own(40);
  for (auto& m : own) m = with_own_texels(map);
  return own;
}

/// Faces and texels that a place shows on average, and bytes of texels (mean, variance) in the chunks that it touches.
void report(benchmark::State& state, const MapPtr& map, const std::vector<Place>& from) {
  double faces = 0, texels = 0, bytes = 0;
  for (const auto& place : from)
    for (const auto& part : place.seen.parts()) {
      const PpmChunk& chunk = map->table()[part.chunk];
      faces += static_cast<double>(part.faces.size());
      for (auto f : part.faces) texels += texel_count(chunk.geometry->divisions[f]);
      bytes += static_cast<double>(chunk.texels->bytes());
    }
  const auto n = static_cast<double>(from.size());
  state.counters["faces"] = faces / n;
  state.counters["texels"] = texels / n;
  state.counters["kB"] = bytes / n / 1e3;
  state.counters["ns/texel"] = benchmark::Counter(texels / n * static_cast<double>(state.iterations()) * 1e-9,
                                                  benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Which faces a view shows.
void visible_faces(benchmark::State& state) {
  const auto map = room(state);
  const auto from = places(map);
  VisibleFaces seen;
  std::size_t i = 0;
  for (auto _ : state) {
    const Place& place = from[i++ % from.size()];
    seen.collect(*map, *place.view, place.frame);
    benchmark::DoNotOptimize(seen.parts().data());
  }
  report(state, map, from);
}

/// The frame between keyframes: visible faces, and their texels in place.
void texels_in_place(benchmark::State& state) {
  const auto map = room(state);
  const auto from = places(map);
  auto own = particles(map);
  VisibleFaces seen;
  std::size_t i = 0;
  for (auto _ : state) {
    const Place& place = from[i % from.size()];
    auto& m = own[i++ % own.size()];
    seen.collect(*m, *place.view, place.frame);
    m = update_visible_texels(std::move(m), place.frame, 1, place.view->T_map_camera, seen, {});
  }
  report(state, map, from);
}

/// The same as the first after resampling: another particle has the map too, so that what is written is copied.
void texels_of_a_copy(benchmark::State& state) {
  const auto map = room(state);
  const auto from = places(map);
  const auto parents = particles(map);
  auto children = parents;
  VisibleFaces seen;
  std::size_t i = 0;
  for (auto _ : state) {
    const Place& place = from[i % from.size()];
    const std::size_t k = i++ % parents.size();
    seen.collect(*parents[k], *place.view, place.frame);
    children[k] = update_visible_texels(parents[k], place.frame, 1, place.view->T_map_camera, seen, {});
  }
  report(state, map, from);
}

/// A keyframe that finds nothing new.
void keyframe(benchmark::State& state) {
  const auto map = room(state);
  const auto from = places(map);
  auto own = particles(map);
  UpdateSettings settings;
  settings.share();
  UpdateScratch scratch;
  std::size_t i = 0;
  for (auto _ : state) {
    const Place& place = from[i % from.size()];
    auto& m = own[i % own.size()];
    m = update_map(std::move(m), place.frame, *place.whole, settings, static_cast<std::int64_t>(i++),
                   test::one_worker(), scratch);
  }
  report(state, map, from);
}

/// The texels of one place over and over, one after the other as the test's reference does it, or by vectors.
void gather(benchmark::State& state, bool vectors) {
  const auto map = room(state);
  const auto from = places(map);
  const auto own = with_own_texels(map);
  TexelSettings settings;
  PpmEdit edit(own);
  UpdateView view;
  std::size_t i = 0;
  for (auto _ : state) {
    const Place& place = from[i++ % from.size()];
    state.PauseTiming();
    view.build(place.frame, *place.whole, test::one_worker());
    state.ResumeTiming();
    const test::GatherReference reference(view, settings);
    for (const auto& part : place.seen.parts()) {
      const Geometry& geometry = *edit.map().table()[part.chunk].geometry;
      Texels& texels = edit.texels(part.chunk);
      if (vectors) {
        gather_faces(gather_image(view), gather_gate(settings), gather_faces_of(geometry, texels), part.faces.data(),
                     part.faces.size());
        continue;
      }
      for (auto f : part.faces) {
        const auto first = geometry.first_texel[f];
        reference.update(corners_in(view, geometry, f), geometry.divisions[f], texels.evidence[f].added_variance(),
                         &texels.mean[first], &texels.variance[first]);
      }
    }
  }
  report(state, map, from);
}
BENCHMARK_CAPTURE(gather, one_by_one, false)
    ->Args({20000, 40, 100})
    ->Args({100000, 40, 100})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(gather, vectors, true)
    ->Args({20000, 40, 100})
    ->Args({100000, 40, 100})
    ->Unit(benchmark::kMicrosecond);

void sizes(benchmark::internal::Benchmark* b) {
  for (int triangles : {20000, 100000})
    for (int texel_mm : {20, 40}) b->Args({triangles, texel_mm, 100});
  for (int cell_cm : {25, 50, 200}) b->Args({20000, 40, cell_cm});
  b->Unit(benchmark::kMicrosecond)->ArgNames({"triangles", "texel_mm", "cell_cm"});
}
BENCHMARK(visible_faces)->Apply(sizes);
BENCHMARK(texels_in_place)->Apply(sizes);
BENCHMARK(texels_of_a_copy)->Apply(sizes);
BENCHMARK(keyframe)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
