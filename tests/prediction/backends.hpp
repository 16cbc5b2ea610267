#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/graph/harness.hpp"
#include "framework/slam/map.hpp"
#include "framework/slam/prediction.hpp"

namespace ppm::test {

/// The modules that answer exactly what a mesh map shows: every prediction.* that needs a "map.ppm" and gives
/// "prediction.elements". A back-end that this machine cannot run is left out, visibly.
std::vector<std::string> exact_backends();

/// What to look at.
struct Look {
  Camera camera;  ///< the frame's
  int stride = 1;
  Pose T_map_camera = Pose::Identity();
  bool cull_back_faces = true;
};

/// Views of one map by a back-end's module, deferred where it defers: its harness and the map live as long as they do.
struct Views {
  std::unique_ptr<Harness> harness;
  std::vector<PredictionHandle> of;  ///< in the order of the looks
};
/// looks: share all but the pose.
Views deferred_views(const std::string& backend, const std::shared_ptr<const Map>& map, const std::vector<Look>& looks,
                     int threads = 1);
/// Single views of one map, with their arrays filled, by a module that stays open from view to view.
class Viewer {
 public:
  Viewer(std::string backend, std::shared_ptr<const Map> map) : backend_(std::move(backend)), map_(std::move(map)) {}
  PredictionHandle see(const Look& look);

 private:
  std::string backend_;
  std::shared_ptr<const Map> map_;
  std::map<std::string, std::unique_ptr<Harness>> harness_;  // by parameters
};
/// The view with its arrays filled. The caller holds the map.
PredictionHandle filled(const PredictionHandle& view);

}  // namespace ppm::test
