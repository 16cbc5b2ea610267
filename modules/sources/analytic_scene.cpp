#include "modules/sources/analytic_scene.hpp"

#include <algorithm>
#include <utility>

#include "framework/core/error.hpp"

namespace ppm {

AnalyticScene::AnalyticScene(std::vector<Solid> solids, std::vector<SceneObject> objects)
    : solids_(std::move(solids)), objects_(std::move(objects)), tree_(solids_) {}

SceneHit AnalyticScene::cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  return in_world(tree_.cast(solids_, origin, direction));
}

SceneHit AnalyticScene::cast_among(const std::vector<std::uint32_t>& among, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) const {
  TreeHit best;
  for (const std::uint32_t solid : among) {
    const SolidHit hit = enter(solids_[solid], origin, direction);
    if (hit.range_m < best.hit.range_m) best = {hit, solid};
  }
  return in_world(best);
}

SceneHit AnalyticScene::in_world(const TreeHit& best) const {
  if (best.solid == TreeHit::kNone) return {};
  return {best.hit.range_m, solids_[best.solid].R_world_local * best.hit.normal, best.solid};
}

double AnalyticScene::distance(const Eigen::Vector3d& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Solid& solid : solids_) least = std::min(least, signed_distance(solid, p));
  return least;
}

const SceneObject& AnalyticScene::object_of(std::uint32_t solid) const {
  PPM_CHECK(solid < solids_.size(), "solid {} of {}", solid, solids_.size());
  return *std::find_if(objects_.begin(), objects_.end(), [&](const SceneObject& o) { return solid < o.end; });
}

}  // namespace ppm
