#include "framework/roles/empty_map.hpp"

namespace ppm {

EmptyMap::EmptyMap(const std::string& map_facet) : belief(this, {{}, {"belief", map_facet}, {"prediction"}}) {
  params_.add("particles", particles_).range(1, 1'000'000).doc("Number of particles.");
  params_.add_choice("start", start_, {{"reference", Start::reference}, {"identity", Start::identity}})
      .doc(
          "The camera's first pose in the map frame: the frame's reference pose, so that map and reference share one "
          "frame, or identity.");
}

void EmptyMap::tick(Context&) {
  const auto first = frame.get();
  const Pose T_map_camera = start_pose(*first);
  auto& particles = *belief;
  particles.init(static_cast<std::size_t>(particles_), T_map_camera, make(*first));
  if (start_ == Start::identity) {
    particles.T_map_world.reset();
    if (const auto& reference = first->T_world_camera_ref) particles.T_map_world = reference->inverse();
  }
  for (std::size_t i = 0; i < particles.size(); ++i) particles.extend(i, {first->index, first->stamp_s, T_map_camera});
}

Pose EmptyMap::start_pose(const Frame& first) const {
  if (start_ == Start::identity) return Pose::Identity();
  if (!first.T_world_camera_ref)
    throw DataError("the source", first.index, "has no reference pose to start the map at; set `start: identity`");
  return *first.T_world_camera_ref;
}

}  // namespace ppm
