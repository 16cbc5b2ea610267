#include "framework/roles/map_update.hpp"

#include <algorithm>
#include <numbers>

namespace ppm {

MapUpdate::MapUpdate(Facets facets) : MapEditor(std::move(facets)), keyframe_angle_(10 * std::numbers::pi / 180) {}

void MapUpdate::add_keyframe_params() {
  params_.add("keyframe_every", keyframe_every_)
      .range(1, 1000000)
      .doc("Mapped frames from one keyframe to the next. Keyframes do all that this module does.");
  params_.add("keyframe_distance", keyframe_distance_)
      .unit("m")
      .range(0, 1000)
      .doc("A frame between keyframes becomes one, for the particles that are farther than this from their last one ...");
  params_.add("keyframe_angle", keyframe_angle_)
      .unit("rad")
      .range(0, std::numbers::pi)
      .doc("... or turned by more than this.");
  params_.add("keyframe_misses", keyframe_misses_)
      .range(0, 1)
      .doc(
          "A frame between keyframes becomes one, for the particles whose prediction shows nothing at more than this share "
          "of its measured pixels. 1 = never.");
}

void MapUpdate::before(Context&) {
  learns_ = !frame->held_out && !belief->lost;
  if (learns_) number_ = mapped_++;
  keyframed_.assign(belief->size(), 0);
  keyframe_poses_ = &belief->column<Pose>(kKeyframe);
}

MapHandle MapUpdate::edit(Context& context, std::size_t particle, MapHandle map, int worker) {
  if (!learns_) return map;
  if (number_ % keyframe_every_ != 0 && !has_moved(particle) && miss_share(*map, particle, worker) <= keyframe_misses_)
    return between(context, particle, std::move(map), worker);
  keyframed_[particle] = 1;
  return learn(context, particle, std::move(map), worker);
}

void MapUpdate::edited(std::size_t particle, std::size_t by) {
  if (keyframed_[by]) belief->column<Pose>(kKeyframe)[particle] = belief->pose[particle];
}

double MapUpdate::miss_share(const Map&, std::size_t particle, int) {
  const auto& view = belief->prediction[particle];
  return view ? ppm::miss_share(*view, *frame) : 0.0;
}

bool MapUpdate::has_moved(std::size_t particle) const {
  const Pose since = (*keyframe_poses_)[particle].inverse() * belief->pose[particle];
  return since.translation().norm() > keyframe_distance_ || rotation_angle(since) > keyframe_angle_;
}

double miss_share(const Prediction& view, const Frame& frame) {
  const auto cols = static_cast<std::size_t>(view.camera.cols), stride = static_cast<std::size_t>(view.stride);
  std::vector<std::uint32_t> chunk(cols), face(cols);
  std::size_t measured = 0, missed = 0;
  for (int y = 0; y < view.camera.rows; ++y) {
    view.elements({y, y + 1}, chunk, face);
    const auto first = static_cast<std::size_t>(y) * stride * static_cast<std::size_t>(frame.camera.cols);
    for (std::size_t x = 0; x < cols; ++x) {
      if (!frame.valid(static_cast<int>(first + x * stride))) continue;
      ++measured;
      missed += chunk[x] == Prediction::kNone;
    }
  }
  return measured == 0 ? 0.0 : static_cast<double>(missed) / static_cast<double>(measured);
}

}  // namespace ppm
