#pragma once
#include <memory>
#include <string>
#include <utility>

#include "framework/graph/harness.hpp"
#include "framework/roles/view_predictor.hpp"
#include "tests/support/registry.hpp"
#include "tests/support/workers.hpp"

namespace ppm::test {

/// A map that is looked at: frames that a camera without noise would take of it.
class MappedView {
 public:
  explicit MappedView(MapHandle map) : map_(std::move(map)) {}

  static Camera camera() { return {160, 120, 140, 140, 79.5, 59.5}; }
  ViewPredictor& predictor() { return dynamic_cast<ViewPredictor&>(harness_.module()); }
  const MapHandle& map() const { return map_; }

  Prediction view(const Pose& T_map_camera, int stride = 1) {
    predictor().prepare({map_.get()}, one_worker());
    Prediction out;
    out.reset(camera(), stride, T_map_camera);
    predictor().predict_all(*map_, out, 0);
    return out;
  }
  Frame frame(const Pose& T_map_camera, float sigma = 0.003f) {
    const Prediction seen = view(T_map_camera);
    Frame f;
    f.camera = camera();
    f.stamp_s = 1;
    f.index = 1;
    for (std::size_t p = 0; p < seen.range.size(); ++p) {
      const Eigen::Vector3d direction = seen.direction(p);
      const double along_axis = (T_map_camera.linear().transpose() * direction).z();
      const bool hit = seen.hit(p);
      const double range = hit ? seen.expected_range(p, direction) : 0;
      f.depth.push_back(hit ? static_cast<float>(range * along_axis) : std::numeric_limits<float>::quiet_NaN());
      f.sigma.push_back(hit ? sigma : std::numeric_limits<float>::quiet_NaN());
    }
    return f;
  }

 private:
  MapHandle map_;
  Harness harness_{builtin(), "prediction.raster"};
};

}  // namespace ppm::test
