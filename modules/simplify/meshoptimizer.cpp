#include <meshoptimizer.h>

#include "framework/graph/registry.hpp"
#include "modules/simplify/map_simplifier.hpp"

namespace {

using namespace ppm;

/// Makes mature parts of a mesh of fewer faces, by collapsing edges in the order of a quadric error.
/// belief  drops the prediction: its elements are no longer those of the map
/// source  paper, section 4.3; Kapoulkine, meshoptimizer; Garland and Heckbert, SIGGRAPH 1997
class MeshoptimizerSimplifier final : public MapSimplifier {
 protected:
  std::vector<Triangle> decimate(const Decimation& surface) const override {
    if (surface.face.empty()) return {};
    // This release takes no list of locked vertices, but keeps vertices that share their position with two more.
    std::vector<Eigen::Vector3f> position = surface.position;
    for (std::size_t v = 0; v < surface.locked.size(); ++v)
      if (surface.locked[v]) position.insert(position.end(), 2, surface.position[v]);
    const unsigned* indices = surface.face.front().data();
    const std::size_t count = 3 * surface.face.size();
    const float* points = position.front().data();
    const float scale = meshopt_simplifyScale(points, position.size(), sizeof(Eigen::Vector3f));
    std::vector<Triangle> left(surface.face.size());
    const auto kept = meshopt_simplify(left.front().data(), indices, count, points, position.size(),
                                       sizeof(Eigen::Vector3f), 0, surface.error / scale, 0, nullptr);
    left.resize(kept / 3);
    return left;
  }
};

}  // namespace

PPM_MODULES(r) {
  r.add<MeshoptimizerSimplifier>("simplify.meshoptimizer",
                                 "Fewer faces for the same described surface, by the library meshoptimizer: fast.",
                                 "paper, section 4.3; Garland and Heckbert 1997; meshoptimizer");
}
