#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/graph/executor.hpp"
#include "framework/graph/particle_module.hpp"
#include "framework/graph/registry.hpp"

namespace ppm {

/// What toy modules pass along edges.
struct ToyNumber {
  std::int64_t value = 0;
};
struct ToyWord {};
template <>
struct PortType<ToyWord> {
  static constexpr std::string_view name = "word";
};
template <>
struct PortType<ToyNumber> {
  static constexpr std::string_view name = "number";
};

}  // namespace ppm

namespace ppm::test {

/// What the toy modules did, in order: "camera.tick 3".
inline std::vector<std::string>& events() {
  static std::vector<std::string> list;
  return list;
}
inline void note(const Context& context, const std::string& what) {
  events().push_back(fmt::format("{}.{} {}", context.node(), what, context.frame()));
}

/// Numbers 0 .. count-1, one a frame.
class ToySource : public Module {
 public:
  Out<ToyNumber> number{this, "number", "The number of the frame."};
  ToySource() { params_.add("count", count_).range(0, 1e6).doc("Frames before the stream ends."); }
  void open(Context& context) override {
    note(context, "open");
    context.expect_frames(count_);
  }
  void tick(Context& context) override {
    if (context.frame() >= count_) return context.end_of_stream();
    note(context, "tick");
    number.set(std::make_shared<ToyNumber>(ToyNumber{context.frame()}));
  }
  void close(Context& context) override { note(context, "close"); }

 private:
  std::int64_t count_ = 3;
};

/// Has an output of another type.
class ToyWordSource : public Module {
 public:
  Out<ToyWord> word{this, "word", "A word."};
  void tick(Context& context) override { context.end_of_stream(); }
};

/// Makes the particles.
class ToyInit : public Module {
 public:
  InOut<Belief> belief{this, {{}, {"belief", "map.toy"}, {}}};
  ToyInit() { params_.add("particles", particles_).range(1, 1e6).doc("Number of particles."); }
  void tick(Context& context) override {
    note(context, "tick");
    belief->init(static_cast<std::size_t>(particles_), Pose::Identity(), nullptr);
    for (std::size_t i = 0; i < belief->size(); ++i) belief->extend(i, {});
  }

 private:
  int particles_ = 4;
};

/// A map of another kind.
class ToyOtherMap : public Module {
 public:
  InOut<Belief> belief{this, {{}, {"belief", "map.other"}, {}}};
  void tick(Context&) override {}
};

/// Moves each particle by a random step along x.
class ToyWalk : public ParticleModule {
 public:
  In<ToyNumber> number{this, "number", "The frame."};
  InOut<Belief> belief{this, {{"belief"}, {}, {"prediction"}}};
  ToyWalk() {
    params_.add("sigma", sigma_).unit("m").range(0, 10).doc("Standard deviation of a step.");
    params_.add("ends", ends_).doc("Whether the loop ends here.");
  }
  void before(Context& context) override { note(context, "before"); }
  using ParticleModule::tick;
  void tick(Context& context, std::size_t i, int) override {
    Pose next = belief->pose[i];
    next.translation().x() += sigma_ * context.rng("step", i).normal();
    belief->extend(i, {number->value, static_cast<double>(number->value), next});
  }
  void after(Context& context) override { note(context, "after"); }
  bool ends_loop() const override { return ends_; }
  const ParticleSet& particles() const override { return *belief; }

 private:
  double sigma_ = 0.1;
  bool ends_ = false;
};

/// Stands for a predictor of views of toy maps; makes a number from the belief after the loop.
class ToyLook : public ParticleModule {
 public:
  In<ToyNumber> number{this, "number", "The frame."};
  Out<ToyNumber> doubled{this, "doubled", "Twice the number.", &number};
  InOut<Belief> belief{this, {{"map.toy"}, {"prediction"}, {}}};
  void before(Context& context) override { note(context, "before"); }
  using ParticleModule::tick;
  void tick(Context&, std::size_t i, int) override { belief->prediction[i] = std::make_shared<Prediction>(); }
  void after(Context& context) override {
    note(context, "after");
    doubled.set(std::make_shared<ToyNumber>(ToyNumber{2 * number->value}));
  }
  const ParticleSet& particles() const override { return *belief; }
};

/// Weighs by the distance from the origin.
class ToyWeigh : public ParticleModule {
 public:
  InOut<Belief> belief{this, {{"prediction"}, {}, {}}};
  void before(Context& context) override { note(context, "before"); }
  using ParticleModule::tick;
  void tick(Context&, std::size_t i, int) override {
    belief->log_weight[i] -= belief->pose[i].translation().squaredNorm();
  }
  void after(Context& context) override {
    note(context, "after");
    belief->normalize();
    context.metric("ess", belief->ess());
  }
  const ParticleSet& particles() const override { return *belief; }
};

/// Resamples by drawing ancestors.
class ToyPick : public Module {
 public:
  InOut<Belief> belief{this, {{"belief"}, {}, {}}};
  void tick(Context& context) override {
    std::vector<std::uint32_t> ancestors(belief->size());
    for (std::size_t i = 0; i < ancestors.size(); ++i) {
      ancestors[i] = context.rng("ancestor", i).below(static_cast<std::uint32_t>(ancestors.size()));
    }
    belief->gather(ancestors);
  }
};

/// Notes the number that it is given.
class ToySink : public Module {
 public:
  In<ToyNumber> number{this, "number", "What is noted."};
  void open(Context& context) override { note(context, "open"); }
  void tick(Context& context) override { note(context, fmt::format("got {} in", number->value)); }
  void close(Context& context) override { note(context, "close"); }
};

/// Keeps the sum of the numbers, and tells it at the end.
class ToySum : public Module {
 public:
  In<ToyNumber> number{this, "number", "What is summed."};
  void tick(Context&) override { sum_ += number->value; }
  void save(RecordWriter& out) const override { out.add(sum_); }
  void load(RecordReader& in) override { in.take(sum_); }
  void close(Context& context) override { note(context, fmt::format("total {}", sum_)); }

 private:
  std::int64_t sum_ = 0;
};

/// Blows each particle along y, by a wind of its own that changes slowly: state per particle.
class ToyWind : public ParticleModule {
 public:
  InOut<Belief> belief{this, {{"belief"}, {}, {}}};
  void before(Context&) override { belief->column<double>("wind"); }
  using ParticleModule::tick;
  void tick(Context& context, std::size_t i, int) override {
    auto& wind = belief->column<double>("wind")[i];
    wind += context.rng("gust", i).normal();
    Pose next = belief->pose[i];
    next.translation().y() += wind;
    belief->correct(i, next);
  }
  bool starts_loop() const override { return true; }
  const ParticleSet& particles() const override { return *belief; }
};

/// Adds one.
class ToyPlusOne : public Module {
 public:
  In<ToyNumber> number{this, "number", "A number."};
  Out<ToyNumber> sum{this, "sum", "One more.", &number};
  void tick(Context&) override { sum.set(std::make_shared<ToyNumber>(ToyNumber{number->value + 1})); }
};

/// Reads a map of any kind.
class ToyMapSink : public Module {
 public:
  In<Belief> belief{this, {{"map.*"}, {}, {}}};
  void tick(Context& context) override { note(context, "tick"); }
};

/// Notes how many particles have a prediction, without asking for any.
class ToyCount : public Module {
 public:
  In<Belief> belief{this, {{"belief"}, {}, {}}};
  void tick(Context& context) override {
    const auto none = std::count(belief->prediction.begin(), belief->prediction.end(), nullptr);
    note(context, fmt::format("{} views in", static_cast<std::ptrdiff_t>(belief->size()) - none));
  }
};

/// Throws in the frame that its parameter names.
class ToyThrow : public ParticleModule {
 public:
  InOut<Belief> belief{this, {{"belief"}, {}, {}}};
  ToyThrow() {
    params_.add("frame", frame_).range(0, 1e6).doc("The frame.");
    params_.add("kind", kind_).choices({"data", "config", "standard"}).doc("What is thrown.");
  }
  using ParticleModule::tick;
  void tick(Context& context, std::size_t i, int) override {
    if (context.frame() != frame_ || i != 1) return;
    if (kind_ == "data") throw DataError("depth.png", 7, "cut short");
    if (kind_ == "config") throw ConfigError(Place{}, "stride differs");
    throw std::out_of_range("no such element");
  }
  const ParticleSet& particles() const override { return *belief; }

 private:
  std::int64_t frame_ = 0;
  std::string kind_ = "data";
};

inline Registry toy_registry() {
  Registry r;
  r.add<ToySource>("source.toy", "Counts.", "None.");
  r.add<ToyWordSource>("source.toy_word", "Makes words.", "None.");
  r.add<ToyInit>("map.toy", "Makes particles.", "None.");
  r.add<ToyOtherMap>("map.other", "Makes another kind of map.", "None.");
  r.add<ToyWalk>("motion.toy_walk", "Moves particles.", "None.");
  r.add<ToyLook>("prediction.toy", "Looks.", "None.");
  r.add<ToyWeigh>("weighting.toy", "Weighs.", "None.");
  r.add<ToyPick>("resampling.toy", "Picks.", "None.");
  r.add<ToySink>("sink.toy", "Notes numbers.", "None.");
  r.add<ToySum>("sink.toy_sum", "Sums numbers.", "None.");
  r.add<ToyWind>("refinement.toy_wind", "Blows.", "None.");
  r.add<ToyMapSink>("sink.toy_map", "Reads a map.", "None.");
  r.add<ToyCount>("sink.toy_count", "Counts views.", "None.");
  r.add<ToyPlusOne>("preprocess.plus_one", "Adds one.", "None.");
  r.add<ToyThrow>("refinement.toy_throw", "Throws.", "None.");
  return r;
}

/// Builds and runs a graph of toy modules.
struct ToyRun {
  explicit ToyRun(const std::string& yaml, int threads = 1)
      : graph(Graph::build(parse_yaml(yaml, "toy.yaml"), registry())),
        workers(threads),
        context(workers, log, metrics, graph.seed(), {}),
        executor(graph, context) {
    events().clear();
  }
  RunSummary run(std::int64_t max_frames = 1000) { return executor.run(max_frames, stop); }
  static const Registry& registry() {
    static const Registry r = toy_registry();
    return r;
  }

  Graph graph;
  Workers workers;
  Log log{LogLevel::error};
  Metrics metrics;
  Context context;
  Executor executor;
  std::atomic<bool> stop{false};
};

}  // namespace ppm::test
