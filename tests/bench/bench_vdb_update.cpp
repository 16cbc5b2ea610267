// What writing a frame into a particle's occupancy grid costs, one thread: an empty room of 5 x 4 x 2.6 m seen by 160x120
// pixels from 20 places. Argument: voxel size, mm.
#include <benchmark/benchmark.h>

#include "framework/slam/frame.hpp"
#include "modules/maps/vdb/occupancy_update.hpp"
#include "tests/support/workers.hpp"

namespace {

using namespace ppm;
using MapPtr = std::shared_ptr<const VdbMap>;

const Eigen::Vector3d kRoom(5, 4, 2.6);

struct Place {
  Pose T_map_camera;
  Frame frame;
};

/// The room from a place on a circle around its middle.
Place place(double angle) {
  Place place;
  Eigen::Matrix3d R;  // x to the right, y down, z forward
  R.col(2) = Eigen::Vector3d(std::cos(angle), std::sin(angle), -0.2).normalized();
  R.col(0) = R.col(2).cross(Eigen::Vector3d::UnitZ()).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  const Eigen::Vector3d from = kRoom / 2 + Eigen::Vector3d(-std::cos(angle), -std::sin(angle), 0.2);
  place.T_map_camera.linear() = R;
  place.T_map_camera.translation() = from;
  Frame& frame = place.frame;
  frame.camera = {160, 120, 146, 146, 79.5, 59.5};
  for (int i = 0; i < frame.camera.pixels(); ++i) {
    const Eigen::Vector3d ray = R * frame.camera.ray(i % 160, i / 160);
    const Eigen::Vector3d wall = (ray.array() > 0).select(kRoom, Eigen::Vector3d::Zero());
    frame.depth.push_back(static_cast<float>(((wall - from).array() / ray.array()).minCoeff()));
    frame.sigma.push_back(0.0015f * frame.depth.back() * frame.depth.back());
  }
  return place;
}

std::vector<Place> places() {
  std::vector<Place> all;
  for (int i = 0; i < 20; ++i) all.push_back(place(0.314 * i));
  return all;
}

MapPtr after(MapPtr map, const Place& from, const OccupancySettings& settings) {
  OccupancyView view;
  view.build(from.frame, *map, settings);
  return update_occupancy(std::move(map), view, from.T_map_camera, test::one_worker());
}

/// The room seen five times from everywhere.
MapPtr seen_room(const benchmark::State& state, const OccupancySettings& settings) {
  VdbSettings grid;
  grid.voxel_size_m = 1e-3 * static_cast<double>(state.range(0));
  MapPtr map = std::make_shared<const VdbMap>(grid);
  for (int round = 0; round < 5; ++round)
    for (const auto& from : places()) map = after(std::move(map), from, settings);
  return map;
}

void report(benchmark::State& state, const MapPtr& map) {
  const auto stats = map->stats();
  state.counters["MB"] = static_cast<double>(stats.bytes) / 1e6;
  state.counters["tiles"] = static_cast<double>(stats.chunks);
}

/// A frame into a map that no other particle has.
void in_place(benchmark::State& state, OccupancyForm form) {
  OccupancySettings settings;
  settings.form = form;
  auto map = seen_room(state, settings);
  const auto from = places();
  std::size_t i = 0;
  for (auto _ : state) map = after(std::move(map), from[i++ % from.size()], settings);
  report(state, map);
}
BENCHMARK_CAPTURE(in_place, profile, OccupancyForm::profile)->Arg(50)->Arg(20)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(in_place, literal, OccupancyForm::literal)->Arg(50)->Arg(20)->Arg(10)->Unit(benchmark::kMillisecond);

/// The same after resampling: another particle has the map too, so that the tiles written are copied.
void of_a_copy(benchmark::State& state) {
  const auto map = seen_room(state, {});
  const auto from = places();
  std::size_t i = 0;
  std::unordered_set<const void*> seen;
  map->account(seen);
  std::int64_t own = 0;
  for (auto _ : state) {
    const auto child = after(map, from[i++ % from.size()], {});
    state.PauseTiming();
    auto parents = seen;
    own += child->account(parents);
    state.ResumeTiming();
  }
  report(state, map);
  state.counters["own MB"] = static_cast<double>(own) / 1e6 / static_cast<double>(state.iterations());
}
BENCHMARK(of_a_copy)->Arg(50)->Arg(20)->Arg(10)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
