#include <numbers>

#include "framework/graph/registry.hpp"
#include "framework/roles/motion_model.hpp"

namespace {

using namespace ppm;

/// Leaves each particle where it is, but for noise: T_k = T_{k-1} exp(noise). For cameras whose motion says nothing of
/// the next (shaken, handled, or stood on a tripod).
///
/// source  Thrun, Burgard, Fox, "Probabilistic Robotics", 2005, chapter 5
class RandomWalk final : public PathMotion {
 public:
  RandomWalk() : PathMotion({0.02, std::numbers::pi / 180}) {}

 private:
  Pose predict(const Trajectory& path, double) const override { return path.last().T_map_camera; }
};

}  // namespace

PPM_MODULES(r) {
  r.add<RandomWalk>("motion.random_walk", "Leaves each particle where it is, plus noise.",
                    "Thrun, Burgard, Fox, \"Probabilistic Robotics\", 2005, chapter 5");
}
