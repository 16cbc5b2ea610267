#pragma once
#include <cstdint>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

#include "framework/config/params.hpp"
#include "framework/graph/context.hpp"
#include "framework/roles/pose_noise.hpp"
#include "framework/roles/view_aligner.hpp"

namespace ppm {

/// Where a search begins: a pose, and draws around it.
struct SearchStart {
  Pose T_map_camera = Pose::Identity();
  PoseNoise noise;
  int draws = 0;  ///< beside the pose itself
};

/// Tries where in a map a frame was taken: from each start the draws are aligned coarsely to the view from the start, the
/// likeliest of them closely to views of its own, and what then explains the frame with a margin is a place found.
class PlaceSearch {
 public:
  void declare(Params& params);

  /// How far a camera may be from where it was last, so many frames after it was lost.
  PoseNoise spread(std::int64_t age) const;
  /// A start there.
  SearchStart around(const Pose& T_map_camera, std::int64_t age) const { return {T_map_camera, spread(age), local_starts_}; }
  /// A start at a place that looks like the frame.
  SearchStart at_place(const Pose& T_map_camera) const { return {T_map_camera, {start_t_, start_r_}, starts_}; }
  /// Frames for which only the surroundings are searched.
  std::int64_t local_frames() const { return local_frames_; }

  /// The places found, likeliest first, each once. aligner: has begun the frame. predictor: prepared for the map.
  std::vector<Alignment> run(std::span<const SearchStart> starts, const ViewAligner& aligner, const ViewPredictor& predictor,
                             const Map& map, Context& context);

 private:
  Alignment best_of(const SearchStart& start, const ViewAligner& aligner, const ViewPredictor& predictor, const Map& map,
                    const std::function<Rng(int)>& rng, int worker);
  bool accepts(const AlignmentFit& fit) const {
    return fit.outlier_share() <= accept_outliers_ && fit.inlier_share() >= accept_inliers_;
  }

  int starts_ = 8, local_starts_ = 30, local_frames_ = 3;
  double start_t_ = 0.1, start_r_ = 5 * std::numbers::pi / 180;
  double spread_t_ = 0.05, spread_r_ = 3 * std::numbers::pi / 180;
  double spread_most_t_ = 0.5, spread_most_r_ = 30 * std::numbers::pi / 180;
  double accept_outliers_ = 0.1, accept_inliers_ = 0.4;
  PerWorker<AlignScratch> scratch_;
};

}  // namespace ppm
