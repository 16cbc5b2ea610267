#include "modules/recovery/place_search.hpp"

#include <algorithm>
#include <utility>

namespace ppm {

namespace {

/// What is known of a pose in a search: next to nothing, so that only directions that no surface holds stay with the start.
constexpr PoseNoise kVague{0.5, 0.5};
constexpr int kMostDraws = 10000;  // around a start

}  // namespace

void PlaceSearch::declare(Params& params) {
  params.add("local_frames", local_frames_)
      .range(0, 1'000'000)
      .doc("For so many frames after a loss the camera is searched only around where it was last.");
  params.add("local_starts", local_starts_)
      .range(0, kMostDraws)
      .doc("Poses drawn around where the camera was last, in each frame of a search.");
  params.add("spread_t", spread_t_)
      .unit("m")
      .range(0, 100)
      .doc("Standard deviation of those draws' translation: so much for each frame since the loss.");
  params.add("spread_r", spread_r_).unit("rad").range(0, std::numbers::pi).doc("And of their rotation.");
  params.add("spread_most_t", spread_most_t_).unit("m").range(0, 1000).doc("What spread_t grows to.");
  params.add("spread_most_r", spread_most_r_).unit("rad").range(0, std::numbers::pi).doc("What spread_r grows to.");
  params.add("starts", starts_).range(0, kMostDraws).doc("Poses drawn around each place that looks like the frame.");
  params.add("start_t", start_t_).unit("m").range(0, 100).doc("Standard deviation of those draws' translation.");
  params.add("start_r", start_r_).unit("rad").range(0, std::numbers::pi).doc("And of their rotation.");
  params.add("accept_outliers", accept_outliers_)
      .range(0, 1)
      .doc("A place is found where alignment leaves no larger share of outliers among the pixels that the map shows.");
  params.add("accept_inliers", accept_inliers_)
      .range(0, 1)
      .doc("And only where it explains at least this share of the measured pixels.");
}

PoseNoise PlaceSearch::spread(std::int64_t age) const {
  const auto frames = static_cast<double>(age + 1);
  return {std::min(frames * spread_t_, spread_most_t_), std::min(frames * spread_r_, spread_most_r_)};
}

Alignment PlaceSearch::best_of(const SearchStart& start, const ViewAligner& aligner, const ViewPredictor& predictor,
                               const Map& map, const std::function<Rng(int)>& rng, int worker) {
  AlignScratch& scratch = scratch_[worker];
  const MotionPrior prior{start.T_map_camera, kVague.covariance()};
  aligner.look(predictor, map, start.T_map_camera, scratch, worker);
  Alignment best = aligner.align_coarsely(scratch.view, prior, start.T_map_camera);
  for (int k = 0; k < start.draws; ++k) {
    const Alignment at = aligner.align_coarsely(scratch.view, prior, start.T_map_camera * start.noise.draw(rng(k)));
    if (at.likelihood > best.likelihood) best = at;
  }
  return aligner.align(predictor, map, prior, best.T_map_camera, ViewAligner::Manner::wide, scratch, worker);
}

std::vector<Alignment> PlaceSearch::run(std::span<const SearchStart> starts, const ViewAligner& aligner,
                                        const ViewPredictor& predictor, const Map& map, Context& context) {
  scratch_.resize(context.threads());
  std::vector<Alignment> tried(starts.size());
  context.workers().for_each(starts.size(), [&](std::size_t i, int worker) {
    const auto rng = [&](int k) { return context.rng("start", i * static_cast<std::size_t>(kMostDraws) + static_cast<std::size_t>(k)); };
    tried[i] = best_of(starts[i], aligner, predictor, map, rng, worker);
  });
  std::erase_if(tried, [&](const Alignment& at) { return !accepts(at.fit); });
  return distinct_places(std::move(tried));
}

}  // namespace ppm
