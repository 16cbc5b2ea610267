#pragma once
#include <memory>

#include "modules/maps/ppm/ppm_update.hpp"
#include "modules/prediction/embree_scenes.hpp"
#include "modules/prediction/embree_view.hpp"

namespace ppm::test {

/// Predicts and updates one map, frame by frame, with known poses.
class Mapper {
 public:
  explicit Mapper(UpdateSettings settings = {}, PpmSettings map_settings = {})
      : settings_(settings), map_(std::make_shared<PpmMap>(map_settings)) {
    settings_.share();
  }

  const PpmMap& map() const { return *map_; }

  Prediction predict(const Camera& camera, const Pose& T_map_camera) {
    scenes_.update({map_.get()}, workers_);
    Prediction p;
    p.reset(camera, 1, T_map_camera);
    trace_view(*map_, scenes_.of(*map_), EmbreeViewOptions{}, p);
    return p;
  }

  UpdateCounts add(const Frame& frame) {
    const auto seen = predict(frame.camera, *frame.T_world_camera_ref);
    UpdateCounts counts;
    map_ = update_map(std::move(map_), frame, seen, settings_, frames_++, &counts);
    map_->check();
    return counts;
  }

 private:
  UpdateSettings settings_;
  std::shared_ptr<const PpmMap> map_;
  Workers workers_{1};
  EmbreeScenes scenes_{EmbreeOptions{}};
  std::int64_t frames_ = 0;
};

}  // namespace ppm::test
