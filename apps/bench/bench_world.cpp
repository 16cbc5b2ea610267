#include "apps/bench/bench_world.hpp"

#include "framework/core/rng.hpp"
#include "framework/graph/harness.hpp"
#include "modules/maps/ppm/meshed_room.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"

namespace ppm {
namespace {

constexpr int kPlaces = 3;            // in the cycle of frames
constexpr float kDepthSigma = 5e-3f;  // m, of the images
constexpr float kMapSigma = 1e-2f;    // m, of the texels

Camera camera_of(int cols) {
  const double scale = cols / 176.0;
  const int rows = static_cast<int>(144 * scale + 0.5);
  return {cols, rows, 150 * scale, 150 * scale, 0.5 * (cols - 1), 0.5 * (rows - 1)};
}

/// A depth image of the map with the sensor's noise.
std::shared_ptr<const Frame> image(const Registry& registry, const BenchWorld& world, const Camera& camera, int place) {
  auto frame = std::make_shared<Frame>();
  frame->camera = camera;
  frame->T_world_camera_ref = room_view(2.1 * place + 0.5);
  Harness look(registry, "prediction.embree");
  look.input<Frame>("frame", frame);
  look.belief().init(1, *frame->T_world_camera_ref, world.map);
  look.tick();
  PredictionPool pool;
  const PredictionHandle view = completed(look.belief().prediction[0], pool, Workers(1));
  Rng rng(7, static_cast<std::uint32_t>(place), 0, purpose_key("image"));
  for (int p = 0; p < camera.pixels(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    const double z = view->range[i] / camera.ray(p % camera.cols, p / camera.cols).norm();
    frame->depth.push_back(view->hit(i) ? static_cast<float>(z + kDepthSigma * rng.normal()) : NAN);
    frame->sigma.push_back(view->hit(i) ? kDepthSigma : NAN);
  }
  return frame;
}

/// A copy whose chunks are all its own, shape and texels: a vertex of each is moved by a hair.
std::shared_ptr<const PpmMap> own_copy(const std::shared_ptr<const PpmMap>& map, std::uint32_t number) {
  Rng rng(9, 0, number, purpose_key("copy"));
  PpmEdit edit(map);
  for (std::uint32_t c = 0; c < map->table().size(); ++c) {
    const Geometry& g = *map->table()[c].geometry;
    if (g.position.empty()) continue;
    edit.texels(c);
    const auto v = static_cast<std::uint32_t>(g.position.size() / 2);
    edit.move_vertex(c, v, g.position[v] + static_cast<float>(1e-5 * rng.normal()) * g.normal[v]);
  }
  return edit.commit();
}

}  // namespace

const std::vector<std::shared_ptr<const PpmMap>>& BenchWorld::own_maps(std::size_t n) {
  while (own.size() < n) own.push_back(own_copy(map, static_cast<std::uint32_t>(own.size())));
  return own;
}

BenchWorld& BenchWorlds::of(int triangles, int cols) {
  BenchWorld& world = worlds_[{triangles, cols}];
  if (world.map) return world;
  const auto flat = [](const Eigen::Vector3f&) { return 0.f; };
  PpmSettings settings;
  settings.texel_size_m = texel_size_m_;
  world.map = map_of(meshed_room(triangles), settings, flat, kMapSigma * kMapSigma);
  for (int place = 0; place < kPlaces; ++place) world.frames.push_back(image(registry_, world, camera_of(cols), place));
  return world;
}

}  // namespace ppm
