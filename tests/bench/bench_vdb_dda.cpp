// What a view of an occupancy grid costs, beside OpenVDB's own ray walk over a grid of the same values: docs/results/vdb.md.
#include <benchmark/benchmark.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/RayIntersector.h>

#include <algorithm>
#include <array>
#include <map>

#include "modules/maps/ppm/meshed_room.hpp"
#include "modules/prediction/vdb_view.hpp"
#include "tests/support/voxel_map.hpp"

using namespace ppm;

namespace {

const Camera kCamera{176, 144, 150, 150, 87.5, 71.5};

// Signed distance, negative in free space, in a room of 6 x 5 x 2.7 m with boxes on its floor.
double room_distance(const Eigen::Vector3d& p) {
  double d = test::box_distance(p, {0, 0, 0}, {6, 5, 2.7});
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d low(0.5 + 0.53 * i, i % 2 == 0 ? 0.4 : 4.0, 0), high = low + Eigen::Vector3d(0.4, 0.6, 0.3 + 0.12 * i);
    d = std::max(d, -test::box_distance(p, low, high));
  }
  return d;
}

std::shared_ptr<const VdbMap> room(double voxel_m) {
  static std::map<double, std::shared_ptr<const VdbMap>> made;
  auto& map = made[voxel_m];
  if (map) return map;
  const Eigen::Vector3d wall = Eigen::Vector3d::Constant(0.3);
  return map = test::voxel_map({voxel_m, -4, 6}, -wall, Eigen::Vector3d(6, 5, 2.7) + wall, [&](const Eigen::Vector3d& p) {
           return test::surface_log_odds(room_distance(p), 3 / voxel_m, 2.5 * voxel_m);
         });
}

void report(benchmark::State& state, std::int64_t rays) {
  state.counters["Mray/s"] =
      benchmark::Counter(1e-6 * static_cast<double>(rays * state.iterations()), benchmark::Counter::kIsRate);
}

double voxel_of(const benchmark::State& state) { return 0.01 * static_cast<double>(state.range(0)); }

void view(benchmark::State& state) {
  const auto map = room(voxel_of(state));
  VdbView view;
  Prediction out;
  int i = 0;
  for (auto _ : state) {
    out.reset(kCamera, 1, room_view(0.3 * (i++ % 20)));
    view.start(*map, {}, out);
    view.fill(out, all_rows(kCamera), out);
    benchmark::DoNotOptimize(out.range.data());
  }
  report(state, kCamera.pixels());
  state.counters["hit"] = static_cast<double>(std::count_if(out.chunk.begin(), out.chunk.end(),
                                                            [](auto c) { return c != Prediction::kNone; })) /
                          kCamera.pixels();
  state.counters["MB"] = 1e-6 * static_cast<double>(map->stats().bytes);
}

// The pixels that a likelihood compares, alone.
void samples(benchmark::State& state) {
  const auto map = room(voxel_of(state));
  std::vector<std::uint32_t> pixels;
  for (int y = 2; y < kCamera.rows; y += 4)
    for (int x = 2; x < kCamera.cols; x += 4) pixels.push_back(static_cast<std::uint32_t>(y * kCamera.cols + x));
  VdbView view;
  Prediction about;
  ViewSamples out;
  out.resize(pixels.size());
  int i = 0;
  for (auto _ : state) {
    about.reset_deferred(kCamera, 1, room_view(0.3 * (i++ % 20)));
    view.start(*map, {}, about);
    view.sample(about, pixels, out);
    benchmark::DoNotOptimize(out.range.data());
  }
  report(state, static_cast<std::int64_t>(pixels.size()));
}

openvdb::FloatGrid::Ptr grid_of(const VdbMap& map) {
  auto grid = openvdb::FloatGrid::create(0);
  auto accessor = grid->getAccessor();
  for (std::size_t c = 0; c < map.table().size(); ++c)
    for (int i = 0; i < 1 << 12; ++i) {
      const Cell v = map.table().cell(c) * kVdbTileEdge + Cell(i >> 8, i >> 4 & 15, i & 15);
      const auto value = map.log_odds(v);
      if (value && *value > 0) accessor.setValue({v.x(), v.y(), v.z()}, *value);
    }
  return grid;
}

// VolumeRayIntersector over the occupied voxels, up to the first of them: range alone, no surface within the cells.
void openvdb_walk(benchmark::State& state) {
  using Ray = openvdb::math::Ray<double>;
  openvdb::initialize();
  const double h = voxel_of(state);
  const auto grid = grid_of(*room(h));
  openvdb::tools::VolumeRayIntersector<openvdb::FloatGrid> volume(*grid);
  auto accessor = grid->getConstAccessor();
  int i = 0;
  for (auto _ : state) {
    const Pose T = room_view(0.3 * (i++ % 20));
    const Eigen::Vector3d o = T.translation() / h - Eigen::Vector3d::Constant(0.5);  // OpenVDB's voxels are centred
    float sum = 0;
    for (int p = 0; p < kCamera.pixels(); ++p) {
      const Eigen::Vector3d d = T.linear() * kCamera.ray(p % kCamera.cols, p / kCamera.cols).normalized();
      const Ray ray({o.x(), o.y(), o.z()}, {d.x(), d.y(), d.z()});
      if (!volume.setIndexRay(ray)) continue;
      bool found = false;
      for (double from = 0, to = 0; !found && volume.march(from, to);) {
        openvdb::math::DDA<Ray, 0> walk(ray, from, to);
        do {
          if (accessor.getValue(walk.voxel()) > 0) sum += static_cast<float>(walk.time()), found = true;
        } while (!found && walk.step());
      }
    }
    benchmark::DoNotOptimize(sum);
  }
  report(state, kCamera.pixels());
}

BENCHMARK(view)->Arg(5)->Arg(2)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(samples)->Arg(5)->Arg(2)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(openvdb_walk)->Arg(5)->Arg(2)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
