#include "apps/bench/bench_modules.hpp"

#include "framework/graph/particle_module.hpp"

namespace ppm {
namespace {

class BenchSource final : public Module {
 public:
  Out<Frame> frame{this, "frame", "The next image."};
  explicit BenchSource(const BenchWorld& world) : world_(world) {}

  void tick(Context& context) override {
    auto image =
        std::make_shared<Frame>(*world_.frames[static_cast<std::size_t>(context.frame()) % world_.frames.size()]);
    image->index = context.frame();
    image->stamp_s = static_cast<double>(context.frame());
    frame.set(std::move(image));
  }

 private:
  const BenchWorld& world_;
};

class BenchMaps final : public Module {
 public:
  In<Frame> frame{this, "frame", "The first image."};
  InOut<Belief> belief{this, {{}, {"belief", "map.ppm"}, {"prediction"}}};
  explicit BenchMaps(BenchWorld& world) : world_(world) {
    params_.add("particles", particles_).range(1, 1'000'000).doc("Number of particles.");
    params_.add("own", own_).doc("Whether each has a map of its own.");
  }

  void tick(Context&) override {
    const auto n = static_cast<std::size_t>(particles_);
    belief->init(n, *frame->T_world_camera_ref, world_.map);
    if (own_) std::copy_n(world_.own_maps(n).begin(), n, belief->map.begin());
    for (std::size_t i = 0; i < n; ++i) belief->extend(i, {frame->index, frame->stamp_s, belief->pose[i]});
  }

 private:
  BenchWorld& world_;
  int particles_ = 1;
  bool own_ = false;
};

class BenchSnapshot final : public Module {
 public:
  In<Belief> belief{this, {{"belief"}, {}, {}}};
  void tick(Context&) override { kept_ = belief->map; }

 private:
  std::vector<MapHandle> kept_;
};

class BenchFill final : public ParticleModule {
 public:
  InOut<Belief> belief{this, {{"prediction"}, {}, {}}};
  void before(Context& context) override { filled_.resize(context.threads()); }
  using ParticleModule::tick;
  void tick(Context&, std::size_t particle, int worker) override {
    const Prediction& view = *belief->prediction[particle];
    if (!view.deferred) return;
    filled_[worker].reset(view.camera, 1, view.T_map_camera, view.color_channels);
    view.deferred->fill(view, all_rows(view.camera), filled_[worker]);
  }
  const ParticleSet& particles() const override { return *belief; }

 private:
  PerWorker<Prediction> filled_;
};

}  // namespace

void add_bench_modules(Registry& registry, BenchWorld& world) {
  const auto add = [&](const std::string& name, std::function<std::unique_ptr<Module>()> make) {
    registry.add(ModuleInfo{name, "A part of `ppm bench`.", "", "ppm bench", std::move(make)});
  };
  add("source.bench", [&world] { return std::make_unique<BenchSource>(world); });
  add("map.bench", [&world] { return std::make_unique<BenchMaps>(world); });
  add("sink.bench", [] { return std::make_unique<BenchSnapshot>(); });
  add("weighting.bench_fill", [] { return std::make_unique<BenchFill>(); });
}

}  // namespace ppm
