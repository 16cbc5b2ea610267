#include "apps/module_templates.hpp"

namespace ppm {

const char* const kSourceTemplate = R"(#include "framework/graph/registry.hpp"
#include "framework/roles/frame_source.hpp"

namespace {

using namespace ppm;

/// Images of a flat wall: replace by what reads yours.
class Wall final : public FrameSequence {
 public:
  Wall(std::int64_t frames, double distance_m) : frames_(frames), distance_m_(distance_m) {}
  std::string name() const override { return "wall"; }
  std::int64_t size() const override { return frames_; }
  double stamp_s(std::int64_t index) const override { return static_cast<double>(index) / 30; }
  std::optional<Pose> reference_pose(std::int64_t) const override { return Pose::Identity(); }
  Frame read(std::int64_t index) const override {
    Frame frame;
    frame.index = index;
    frame.stamp_s = stamp_s(index);
    frame.camera = {64, 48, 60, 60, 31.5, 23.5};
    frame.depth.assign(static_cast<std::size_t>(frame.camera.pixels()), static_cast<float>(distance_m_));
    frame.T_world_camera_ref = reference_pose(index);
    return frame;
  }

 private:
  std::int64_t frames_;
  double distance_m_;
};

/// Say here what the source gives, in which units and frames, and what it throws.
class NewModule final : public FrameSource {
 public:
  NewModule() {
    params_.add("frames", frames_).range(1, 1e9).doc("Number of images.");
    params_.add("distance", distance_m_).unit("m").above(0).doc("Distance of the wall.");
  }

 private:
  std::unique_ptr<const FrameSequence> open_sequence() const override {
    return std::make_unique<Wall>(frames_, distance_m_);
  }

  std::int64_t frames_ = 10;
  double distance_m_ = 2.0;
};

}  // namespace

PPM_MODULES(r) {
  r.add<NewModule>("category.name", "Images of a flat wall.", "Where the data or its format is described.");
}
)";

const char* const kMotionTemplate =
    R"(#include "framework/graph/registry.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/particle_set.hpp"

namespace {

using namespace ppm;

/// Say here how particles move, with the formula: now each one takes a random step.
class NewModule final : public Module {
 public:
  In<Frame> frame{this, "frame", "Gives index and stamp of the new pose."};
  InOut<Belief> belief{this, {{"belief"}, {}, {"prediction"}}};

  NewModule() {
    params_.add("sigma_t", sigma_t_)
        .unit("m")
        .range(0, 10)
        .doc("Standard deviation of the step, along each axis of the camera.");
  }

  void tick(Context& context) override {
    context.workers().for_each(belief->size(), [&](std::size_t i, int) {
      Rng rng = context.rng("step", i);
      const Eigen::Vector3d step{rng.normal(), rng.normal(), rng.normal()};
      Pose T_map_camera = belief->pose[i];
      T_map_camera.translate(sigma_t_ * step);
      belief->extend(i, {frame->index, frame->stamp_s, T_map_camera});
    });
  }

 private:
  double sigma_t_ = 0.01;
};

}  // namespace

PPM_MODULES(r) {
  r.add<NewModule>("category.name", "Moves each particle by a random step.", "Where the method is described.");
}
)";

const char* const kPredictionTemplate = R"(#include "framework/graph/registry.hpp"
#include "framework/roles/view_predictor.hpp"

namespace {

using namespace ppm;

/// Say here how views are made, and what exactly range, mean and variance
/// are: now the map is never hit.
class NewModule final : public ViewPredictor {
 public:
  NewModule() : ViewPredictor("map.ppm") {}

  void prepare(const std::vector<const Map*>&, const Workers&) override {}
  void predict(const Map&, const Rows&, Prediction&, int) const override {}
};

}  // namespace

PPM_MODULES(r) {
  r.add<NewModule>("category.name", "Predicts that nothing is seen.", "Where the method is described.");
}
)";

const char* const kWeightingTemplate = R"(#include <cmath>

#include "framework/graph/registry.hpp"
#include "framework/roles/weighting.hpp"

namespace {

using namespace ppm;

/// Say here what the likelihood is, with the formula: now exp(-|measured -
/// expected| / scale), independent over pixels.
class NewModule final : public Weighting {
 public:
  NewModule() : Weighting(0) {  // by default all pixels are compared
    params_.add("scale", scale_m_).unit("m").above(0).doc("Mean absolute error that is expected of a range.");
  }

 protected:
  ViewScore score(const PixelBlock& pixels) const override {
    ViewScore s;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (!pixels.hit(i)) {
        ++s.misses;
        continue;
      }
      const double off = pixels.residual(i);
      s.log_likelihood -= std::abs(off) / scale_m_;
      s.residual_sum += std::abs(off);
      ++s.hits;
    }
    return s;
  }

 private:
  double scale_m_ = 0.5;
};

}  // namespace

PPM_MODULES(r) {
  r.add<NewModule>("category.name", "Weighs particles by a product of Laplace densities.",
                   "Where the method is described.");
}
)";

const char* const kMapUpdateTemplate = R"(#include "framework/graph/registry.hpp"
#include "framework/roles/map_editor.hpp"
#include "framework/slam/frame.hpp"

namespace {

using namespace ppm;

/// Say here how a measurement changes a map: now it does not.
class NewModule final : public MapEditor {
 public:
  In<Frame> frame{this, "frame", "The measured image."};

  NewModule() : MapEditor({{"map.ppm", "prediction.elements"}, {}, {}}) {}

  MapHandle edit(Context&, std::size_t, MapHandle map, int) override { return map; }
};

}  // namespace

PPM_MODULES(r) {
  r.add<NewModule>("category.name", "Leaves every map as it is.", "Where the method is described.");
}
)";

const char* const kSinkTemplate = R"(#include "framework/core/atomic_file.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"

namespace {

using namespace ppm;

/// Say here what is written, and its format: now the effective sample size, a
/// line a frame.
class NewModule final : public Module {
 public:
  In<Belief> belief{this, {{"belief"}, {}, {}}};

  NewModule() { params_.add("file", file_).doc("Name of the file."); }

  void tick(Context& context) override { text_ += fmt::format("{} {}\n", context.frame(), belief->ess()); }
  void close(Context& context) override { write_file(context.output(file_), text_); }

 private:
  std::string file_ = "category.name.txt";
  std::string text_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<NewModule>("category.name", "Writes the effective sample size.", "Where the format is described.");
}
)";

const char* const kBeliefTemplate = R"(#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"

namespace {

using namespace ppm;

/// Say here what the module does, with the formula: now it records the weight
/// of the best particle.
class NewModule final : public Module {
 public:
  InOut<Belief> belief{this, {{"belief"}, {}, {}}};

  void tick(Context& context) override { context.metric("best_log_weight", belief->log_weight[belief->best()]); }
};

}  // namespace

PPM_MODULES(r) {
  r.add<NewModule>("category.name", "Records the weight of the best particle.", "Where the method is described.");
}
)";

}  // namespace ppm
