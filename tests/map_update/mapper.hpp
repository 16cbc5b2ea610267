#pragma once
#include <memory>

#include "modules/maps/ppm/ppm_update.hpp"
#include "modules/prediction/embree_scenes.hpp"
#include "modules/prediction/embree_view.hpp"

namespace ppm::test {

/// Predicts and updates one map, frame by frame, with known poses.
class Mapper {
 public:
  explicit Mapper(UpdateSettings settings = {}, PpmSettings map_settings = {}, int threads = 1)
      : settings_(settings), map_(std::make_shared<PpmMap>(map_settings)), workers_(threads) {
    settings_.share();
  }
  /// Goes on from a map.
  explicit Mapper(std::shared_ptr<const PpmMap> map) : map_(std::move(map)) { settings_.share(); }

  const PpmMap& map() const { return *map_; }
  std::shared_ptr<const PpmMap> handle() const { return map_; }

  Prediction predict(const Camera& camera, const Pose& T_map_camera, int stride = 1) {
    scenes_.update({map_.get()}, workers_);
    Prediction p;
    p.reset(camera, stride, T_map_camera, map_->color_channels());
    trace_view(*map_, scenes_.of(*map_), EmbreeViewOptions{}, all_rows(p.camera), p);
    return p;
  }

  /// Share of the camera's rays that meet a second surface, parallel to the first to 45 degrees, within 5 cm behind it.
  double second_layers(const Camera& camera, const Pose& T_map_camera) {
    const auto first = predict(camera, T_map_camera);
    int hits = 0, seconds = 0;
    for (int y = 0; y < camera.rows; ++y)
      for (int x = 0; x < camera.cols; ++x) {
        const auto p = static_cast<std::size_t>(y * camera.cols + x);
        if (!first.hit(p)) continue;
        ++hits;
        const Eigen::Vector3d ray = (T_map_camera.linear() * camera.ray(x, y)).normalized();
        const auto behind = beyond(T_map_camera.translation() + ray * (first.range[p] + 0.002), ray);
        const Eigen::Vector3f n(first.normal[3 * p], first.normal[3 * p + 1], first.normal[3 * p + 2]);
        seconds += behind.hit(0) && behind.range[0] < 0.05f &&
                   n.dot(Eigen::Vector3f(behind.normal[0], behind.normal[1], behind.normal[2])) > 0.7f;
      }
    return static_cast<double>(seconds) / hits;
  }

  UpdateCounts add(const Frame& frame) {
    const auto seen = predict(frame.camera, *frame.T_world_camera_ref);
    UpdateCounts counts;
    map_ = update_map(std::move(map_), frame, seen, settings_, frames_++, workers_, scratch_, &counts);
    map_->check();
    return counts;
  }

 private:
  /// What a single ray sees.
  Prediction beyond(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
    Camera one;
    one.cols = one.rows = 1;
    one.fx = one.fy = 1;
    Pose T = Pose::Identity();
    T.translate(origin);
    T.rotate(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), ray));
    return predict(one, T);
  }

  UpdateSettings settings_;
  std::shared_ptr<const PpmMap> map_;
  Workers workers_{1};
  EmbreeScenes scenes_{EmbreeOptions{}};
  std::int64_t frames_ = 0;
  UpdateScratch scratch_;
};

}  // namespace ppm::test
