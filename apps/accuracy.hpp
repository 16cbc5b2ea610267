#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/graph/graph.hpp"
#include "framework/roles/holdout.hpp"
#include "framework/roles/revisits.hpp"
#include "framework/slam/estimate.hpp"
#include "framework/slam/surface_score.hpp"
#include "framework/slam/trajectory_error.hpp"

namespace ppm {

/// How good path and map of a run are, as far as the source lets it be measured.
struct Accuracy {
  std::optional<TrajectoryError> trajectory;  ///< where the source has at least 2 reference poses of the path's frames
  /// Likewise of what was said of each frame when it was there, where a node kept that, and which pose it was.
  std::optional<TrajectoryError> trajectory_online;
  Estimate online_estimate = Estimate::best;
  /// Where frames were held out and the graph has a view predictor: looked at from the reference poses, where the source
  /// has them, and from the path's own, where these are not the reference.
  std::optional<Holdout> holdout, holdout_estimated;
  std::optional<SurfaceScore> surface;  ///< of the map, where the source knows its true surface and saw something of it
  std::optional<ReprojectionError> revisits;  ///< where a place was seen again; of the path's own poses
};

/// The graph's first view predictor, where it can look at maps of this kind; else null.
ViewPredictor* predictor_for(const Graph& graph, const Map& map);

enum class HoldoutFrom { both, reference, estimated };

/// path: poses of all frames of the run, the last of which is image `last_index` of the source. map: null where there
/// is none. The graph's source must be open. Throws DataError; ConfigError where `from` asks for reference poses alone and
/// the source has none.
Accuracy measure_accuracy(const Graph& graph, const std::vector<StampedPose>& path, std::int64_t last_index,
                          const Map* map, HoldoutFrom from, const Workers& workers);

/// The errors of the online path, into `accuracy`, and how well images of one place agree with the poses of the path. Both
/// read nothing of the map. The graph's source must be open. Throws DataError.
void measure_path(const Graph& graph, const std::vector<StampedPose>& path, const Workers& workers, Accuracy& accuracy);

/// A line about revisits. settings: as they were scored.
std::string revisits_line(const ReprojectionError& error, const RevisitSettings& settings);
/// A table of a few lines for the terminal; "" where nothing could be measured.
std::string accuracy_table(const Accuracy& accuracy);

}  // namespace ppm
