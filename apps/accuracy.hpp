#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/graph/graph.hpp"
#include "framework/roles/holdout.hpp"
#include "framework/slam/trajectory_error.hpp"

namespace ppm {

/// How good path and map of a run are, as far as the source lets it be measured.
struct Accuracy {
  std::optional<TrajectoryError> trajectory;  ///< where the source has at least 2 reference poses of the path's frames
  /// Where frames were held out and the graph has a view predictor: looked at from the reference poses, where the source
  /// has them, and from the path's own, where these are not the reference.
  std::optional<Holdout> holdout, holdout_estimated;
};

enum class HoldoutFrom { both, reference, estimated };

/// path: poses of all frames of the run, the last of which is image `last_index` of the source. map: null where there
/// is none. The graph's source must be open. Throws DataError; ConfigError where `from` asks for reference poses alone and
/// the source has none.
Accuracy measure_accuracy(const Graph& graph, const std::vector<StampedPose>& path, std::int64_t last_index,
                          const Map* map, HoldoutFrom from, const Workers& workers);

/// A table of a few lines for the terminal; "" where nothing could be measured.
std::string accuracy_table(const Accuracy& accuracy);

}  // namespace ppm
