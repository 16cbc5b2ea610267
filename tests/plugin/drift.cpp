#include "framework/graph/particle_module.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/frame.hpp"

namespace {
using namespace ppm;

/// Moves every particle by one step along its optical axis: the smallest motion model there is.
class Drift : public ParticleModule {
 public:
  In<Frame> frame{this, "frame", "Gives the time of the new pose."};
  InOut<Belief> belief{this, {{"belief"}, {}, {"prediction"}}};

  Drift() { params_.add("step", step_).unit("m").range(-1, 1).doc("Way from frame to frame."); }
  using ParticleModule::tick;
  void tick(Context&, std::size_t i, int) override {
    belief->extend(i, {frame->index, frame->stamp_s, belief->pose[i] * Eigen::Translation3d(0, 0, step_)});
  }
  const ParticleSet& particles() const override { return *belief; }

 private:
  double step_ = 0.01;
};

}  // namespace

PPM_MODULES(r) {
  r.add<Drift>("motion.drift", "Moves every particle by one step.", "An example.");
}
