#pragma once
#include <cstddef>
#include <limits>
#include <mutex>
#include <vector>

#include "framework/core/parallel.hpp"
#include "framework/graph/particle_module.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/innovation.hpp"
#include "framework/slam/measured_pixels.hpp"
#include "framework/slam/pixel_block.hpp"
#include "framework/slam/view_score.hpp"

namespace ppm {

/// Base of every `weighting.*`: adds the log likelihood of a frame to every particle and normalises. It knows no map: a
/// likelihood compares ranges, and what else a prediction says.
/// Where no particle's map shows anything at a compared pixel, or no particle's new weight is finite, the weights stay
/// as they were: a warning says so once, and the metric `degenerate` is 1 in that frame. A particle whose likelihood is
/// no number gets weight 0.
/// With `ess_target` the likelihood is tempered by what this frame does to the weights, see temper_for_ess(): an exponent
/// from `temper_least` to 1, beside any that the likelihood has of its own.
///
/// belief   needs a prediction of the frame's own camera (any stride); changes log_weight, and says how far each view fits (see ViewFit)
///
/// metrics  ess, entropy (nats), degenerate; miss_weight (share of compared pixels where the map shows nothing, mean over the
///          weighted particles); of the best particle: residual (mean absolute, m), outlier_share (of hits), miss_share (of
///          compared pixels), innovation_mean and innovation_variance (of the normalised residuals, see Innovation);
///          where there is a target, temper: the exponent
class Weighting : public ParticleModule {
 public:
  In<Frame> frame{this, "frame", "The measured image."};
  InOut<Belief> belief;

  void before(Context& context) override;
  using ParticleModule::tick;
  void tick(Context& context, std::size_t particle, int worker) override;
  void after(Context& context) override;
  void save(RecordWriter& out) const override { out.add(warned_); }
  void load(RecordReader& in) override { in.take(warned_); }
  /// after() normalises.
  bool ends_loop() const override { return true; }
  const ParticleSet& particles() const override { return *belief; }

 protected:
  /// pixels: default of the parameter of that name.
  explicit Weighting(int pixels);
  /// What some of the measured pixels say: each view's are taken in blocks of block_size(), in order, and the scores
  /// added up, so that what is expected of a block is weighed while it is in the nearest cache. Called from any worker.
  virtual ViewScore score(const PixelBlock& pixels) const = 0;
  /// Most pixels of a block; kWholeView for a likelihood that must see all of a view's at once.
  virtual std::size_t block_size() const { return kBlockSize; }
  static constexpr std::size_t kBlockSize = 1024, kWholeView = std::numeric_limits<std::size_t>::max();
  /// Whether PixelBlock::expected is to have colour.
  virtual bool uses_color() const { return false; }

  double jump_m_ = 0;  ///< see PixelGrid; for likelihoods that leave jumps out

 private:
  const MeasuredPixels& measured(const Prediction& prediction);
  /// How far the views fit, in the belief and in the metrics.
  void record(Context& context);

  int pixels_;
  double ess_target_ = 0, temper_least_ = 0.01;
  enum class Phase { centred, random } phase_ = Phase::centred;
  double phase_x_ = 0.5, phase_y_ = 0.5;  // of this frame, in steps
  std::mutex mutex_;  // guards measured_: made by the first tick of a frame, when the prediction's stride is known
  bool measured_made_ = false;
  MeasuredPixels measured_;
  PerWorker<ViewSamples> expected_;
  std::vector<ViewScore> scores_;        // of this frame's particles, from tick() to after()
  std::vector<Innovation> innovations_;  // likewise
  bool warned_ = false;
};

}  // namespace ppm
