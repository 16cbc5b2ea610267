#include "framework/roles/weighting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "framework/slam/tempering.hpp"
#include "framework/slam/view_fit.hpp"

namespace ppm {
namespace {

double entropy(const std::vector<double>& log_weight) {
  double sum = 0;
  for (double l : log_weight)
    if (std::isfinite(l)) sum -= std::exp(l) * l;
  return sum;
}

}  // namespace

Weighting::Weighting(int pixels) : belief(this, {{"prediction"}, {"fit"}, {}}), pixels_(pixels) {
  params_.add("pixels", pixels_)
      .range(0, 1e8)
      .doc(
          "About how many pixels of the predicted image to compare, on a regular grid (the finest that has no more); 0 "
          "compares all.");
  params_.add_choice("phase", phase_, {{"centred", Phase::centred}, {"random", Phase::random}})
      .doc(
          "Where the grid of compared pixels starts: centred in every frame alike, or random for each frame (one grid "
          "for all particles).");
  params_.add("ess_target", ess_target_)
      .range(0, 1)
      .doc(
          "The log likelihood is scaled down in each frame until the effective sample size is at least this share of the "
          "particles; 0 leaves it as it is. It is never scaled up.");
  params_.add("temper_least", temper_least_)
      .range(0, 1)
      .above(0)
      .doc("The smallest factor that `ess_target` may choose, so that frames always count.");
}

void Weighting::before(Context& context) {
  measured_made_ = false;
  expected_.resize(context.threads());
  scores_.assign(belief->size(), {});
  innovations_.assign(belief->size(), {});
  if (phase_ == Phase::random) {
    Rng rng = context.rng("phase");
    phase_x_ = rng.uniform();
    phase_y_ = rng.uniform();
  }
}

const MeasuredPixels& Weighting::measured(const Prediction& prediction) {
  std::lock_guard lock(mutex_);
  if (measured_made_) return measured_;
  PixelGrid grid;
  grid.jump_m = jump_m_;
  const Camera& camera = prediction.camera;
  auto count = [&](int step) { return ((camera.cols + step - 1) / step) * ((camera.rows + step - 1) / step); };
  while (pixels_ > 0 && count(grid.step) > pixels_) ++grid.step;
  grid.first_x = static_cast<int>(phase_x_ * grid.step);
  grid.first_y = static_cast<int>(phase_y_ * grid.step);
  measured_ = measured_pixels(*frame, camera, prediction.stride, grid);
  measured_made_ = true;
  return measured_;
}

void Weighting::tick(Context&, std::size_t particle, int worker) {
  const Prediction& prediction = *belief->prediction[particle];
  const MeasuredPixels& pixels = measured(prediction);
  ViewSamples& expected = expected_[worker];
  const int channels = uses_color() ? prediction.color_channels : 0;
  ViewScore& total = scores_[particle];
  for (std::size_t first = 0; first < pixels.size(); first += expected.size()) {
    expected.resize(std::min(block_size(), pixels.size() - first), channels);
    prediction.sample(std::span(pixels.pixel).subspan(first, expected.size()), expected);
    const PixelBlock block(*frame, pixels, first, expected);
    total += score(block);
    innovations_[particle].add(block);
  }
}

void Weighting::after(Context& context) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  std::vector<double> likelihood(scores_.size());
  bool any_hit = false, any_finite = false;
  for (std::size_t i = 0; i < scores_.size(); ++i) {
    const double l = scores_[i].log_likelihood;
    likelihood[i] = std::isfinite(l) && std::isfinite(belief->log_weight[i]) ? l : kNone;
    any_hit |= scores_[i].hits > 0;
    any_finite |= std::isfinite(likelihood[i]);
  }
  const bool degenerate = !any_hit || !any_finite;
  double temper = 1;
  if (!degenerate) {
    const double target = ess_target_ * static_cast<double>(likelihood.size());
    if (ess_target_ > 0) temper = temper_for_ess(belief->log_weight, likelihood, target, temper_least_);
    for (std::size_t i = 0; i < likelihood.size(); ++i) belief->log_weight[i] += temper * likelihood[i];
    belief->normalize();
  } else if (!warned_) {
    context.log().warning("{}: frame {}: {}; weights stay as they were (said once)", context.node(), context.frame(),
                          any_hit ? "no particle has a finite weight" : "no compared pixel hits a map");
    warned_ = true;
  }
  record(context);
  context.metric("degenerate", degenerate ? 1.0 : 0.0);
  if (ess_target_ > 0) context.metric("temper", temper);
}

void Weighting::record(Context& context) {
  auto& fits = belief->column<ViewFit>(kViewFitColumn);
  double miss_weight = 0;
  for (std::size_t i = 0; i < scores_.size(); ++i) {
    fits[i] = ViewFit::of(scores_[i]);
    miss_weight += std::exp(belief->log_weight[i]) * static_cast<double>(fits[i].misses);
  }
  const ViewScore& best = scores_[belief->best()];
  const ViewFit fit = fits[belief->best()];
  const Innovation& innovation = innovations_[belief->best()];
  context.metric("ess", belief->ess());
  context.metric("entropy", entropy(belief->log_weight));
  context.metric("residual", best.hits > 0 ? best.residual_sum / static_cast<double>(best.hits) : 0.0);
  context.metric("outlier_share", static_cast<double>(fit.outliers));
  context.metric("miss_share", static_cast<double>(fit.misses));
  context.metric("miss_weight", miss_weight);
  context.metric("innovation_mean", innovation.mean());
  context.metric("innovation_variance", innovation.variance());
}

}  // namespace ppm
