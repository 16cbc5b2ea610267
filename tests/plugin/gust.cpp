#include "framework/graph/particle_module.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/frame.hpp"

namespace {
using namespace ppm;

/// What a particle keeps from frame to frame.
struct Wind {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m a frame
  std::vector<double> gusts;                           // all so far
};
void save(RecordWriter& out, const Wind& wind) {
  out.add(wind.velocity);
  out.add(wind.gusts);
}
void load(RecordReader& in, Wind& wind) {
  in.take(wind.velocity);
  in.take(wind.gusts);
}

/// Blows each particle along by a wind of its own, which grows by random gusts, and by the mean of all gusts so far: poses
/// depend on a column that is no plain type.
class Gust : public ParticleModule {
 public:
  In<Frame> frame{this, "frame", "Gives the time of the new pose."};
  InOut<Belief> belief{this, {{"belief"}, {}, {"prediction"}}};

  void before(Context&) override { belief->column<Wind>("gust/wind"); }
  using ParticleModule::tick;
  void tick(Context& context, std::size_t i, int) override {
    auto& wind = belief->column<Wind>("gust/wind")[i];
    Rng rng = context.rng("gust", i);
    wind.gusts.push_back(1e-3 * rng.normal());
    double mean = 0;
    for (double g : wind.gusts) mean += g / static_cast<double>(wind.gusts.size());
    wind.velocity += Eigen::Vector3d(wind.gusts.back(), mean, 0);
    belief->extend(i, {frame->index, frame->stamp_s, belief->pose[i] * Eigen::Translation3d(wind.velocity)});
  }
  const ParticleSet& particles() const override { return *belief; }
};

}  // namespace

PPM_MODULES(r) {
  r.add<Gust>("motion.gust", "Blows every particle along.", "An example.");
}
