#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/core/rng.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/maps/ppm/ppm_update.hpp"
#include "modules/maps/ppm/remesh.hpp"
#include "modules/maps/ppm/vertex_adjust.hpp"
#include "modules/prediction/embree_scenes.hpp"
#include "modules/prediction/embree_view.hpp"
#include "tests/map_update/box_world.hpp"

namespace ppm::test {

/// Particles whose maps live as in a run, in random order: updated from noisy images, at wrong poses, of a room with a
/// box, adjusted, remeshed, and copied by resampling.
class MapLife {
 public:
  enum class Event { update, adjust, remesh, gather };

  explicit MapLife(std::uint32_t seed) : rng_(seed, 0, 0, purpose_key("life")) {
    PpmSettings settings;
    settings.cell_size_m = 0.7;
    settings.texel_size_m = 0.06;
    belief_.init(3, Pose::Identity(), std::make_shared<const PpmMap>(settings));
    world_.boxes.push_back({Eigen::Vector3d(-0.4, -0.3, 1.2), Eigen::Vector3d(0.3, 0.4, 1.7)});
    update_.share();
    adjust_.least = 0.0005f;
    adjust_.sigmas = 1;
    adjust_.boundary = true;
    remesh_.bend.least = 0.006f;
    remesh_.bend.sigmas = 2;
  }

  const ParticleSet& belief() const { return belief_; }
  std::shared_ptr<const PpmMap> map(std::size_t i) const {
    return std::static_pointer_cast<const PpmMap>(belief_.map[i]);
  }
  /// The particle that the last step changed; for a gather none in particular.
  std::size_t particle() const { return particle_; }
  std::size_t changed = 0;  ///< vertices moved and inserted so far

  Event step() {
    particle_ = rng_.below(static_cast<std::uint32_t>(belief_.size()));
    const auto choice = rng_.below(10);
    const Event event = choice < 4   ? Event::update
                        : choice < 6 ? Event::adjust
                        : choice < 9 ? Event::remesh
                                     : Event::gather;
    if (event == Event::gather) {
      belief_.gather({particle_, rng_.below(3), rng_.below(3)});
      return event;
    }
    auto map = std::static_pointer_cast<const PpmMap>(std::move(belief_.map[particle_]));
    belief_.map[particle_] = event == Event::update   ? update(std::move(map))
                             : event == Event::adjust ? adjust(std::move(map))
                                                      : divide(std::move(map));
    return event;
  }

 private:
  std::shared_ptr<const PpmMap> update(std::shared_ptr<const PpmMap> map) {
    const Pose pose = look({0.6 * rng_.uniform() - 0.3, 0.4 * rng_.uniform() - 0.2, 0.4 * rng_.uniform() - 0.2},
                           0.8 * rng_.uniform() - 0.4, 0.4 * rng_.uniform() - 0.2);
    const Pose wrong = pose * Eigen::Translation3d(0.01 * rng_.normal(), 0.01 * rng_.normal(), 0.01 * rng_.normal());
    const Frame frame = world_.frame(small_camera(), wrong, 0.006, frames_, true);
    scenes_.update({map.get()}, workers_);
    Prediction seen;
    seen.reset(frame.camera, 1, pose);
    trace_view(*map, scenes_.of(*map), EmbreeViewOptions{}, all_rows(seen.camera), seen);
    return update_map(std::move(map), frame, seen, update_, frames_++, workers_, scratch_);
  }
  std::shared_ptr<const PpmMap> adjust(std::shared_ptr<const PpmMap> map) {
    AdjustCounts counts;
    map = adjust_vertices(std::move(map), adjust_, &counts);
    changed += counts.moved;
    return map;
  }
  std::shared_ptr<const PpmMap> divide(std::shared_ptr<const PpmMap> map) {
    RemeshCounts counts;
    remesh_.form = rng_.below(4) == 0 ? SplitForm::insert : SplitForm::bisect;
    map = remesh(std::move(map), remesh_, &counts);
    changed += counts.inserted;
    return map;
  }

  Rng rng_;
  ParticleSet belief_;
  BoxWorld world_;
  UpdateSettings update_;
  AdjustSettings adjust_;
  RemeshSettings remesh_;
  Workers workers_{1};
  EmbreeScenes scenes_{EmbreeOptions{}};
  std::uint32_t frames_ = 0;
  UpdateScratch scratch_;
  std::uint32_t particle_ = 0;
};

}  // namespace ppm::test
