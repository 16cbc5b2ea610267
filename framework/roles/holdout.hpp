#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/parallel.hpp"
#include "framework/roles/frame_filter.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/roles/view_predictor.hpp"
#include "framework/slam/color_score.hpp"
#include "framework/slam/depth_score.hpp"
#include "framework/slam/trajectory.hpp"

namespace ppm {

/// Name of poses of a map that is in the reference's frame.
constexpr const char* kReferencePoses = "reference";

/// Where held-out frames are looked at from.
struct HoldoutPoses {
  std::string name;  ///< "reference", "reference, aligned", "estimated" or "estimated, between neighbours"
  /// T_map_camera of a frame; nothing where there is none for it.
  std::function<std::optional<Pose>(const Frame&)> T_map_camera;
};

/// T_map_ref: the identity where `path` is the reference itself (mapping with known poses: the map is in the reference's
/// frame); else the rigid motion that takes the reference's poses nearest to the path's, over all frames that both have: the
/// chordal mean of the rotations, then the mean of the translations. (The alignment of the trajectory error looks at positions
/// alone, which leaves the rotation open on a straight or a short path.) Throws DataError where they have no frame in common.
Pose map_from_reference(const std::vector<StampedPose>& path, const std::vector<StampedPose>& reference);
/// The frames' reference poses, moved by map_from_reference().
HoldoutPoses reference_poses(const std::vector<StampedPose>& path, const std::vector<StampedPose>& reference);
/// The path's own poses of the frames, where it followed them. Else interpolated by stamp between neighbouring poses of the
/// path, which is worse than what the filter would have found; none before its first and after its last pose.
HoldoutPoses estimated_poses(std::vector<StampedPose> path, bool followed);

/// The pixels (x, y) with x % step == y % step == step/2 of a held-out frame are compared.
constexpr int kHoldoutStep = 8;

/// What the map says of one held-out frame.
struct FrameScore {
  std::int64_t index = 0;  ///< of the image
  DepthScore score;
};

struct Holdout {
  DepthScore score;
  std::vector<FrameScore> by_frame;  ///< of those that have a measured pixel to compare, ascending
  std::optional<ColorScore> color;  ///< where map and frames have colour, and something of it was seen
  std::size_t frames = 0;  ///< held-out frames that had a pose
  std::string poses;       ///< HoldoutPoses::name
};

/// Predicts the held-out frames of a source (open) up to index `last` from a map of the kind that the predictor can
/// look at, and compares. sensor: models that are applied to each held-out frame, in this order (see sensor_models); without
/// any, sigma is the source's. Nothing where no such frame has a pose. The same numbers for any number of workers. Throws
/// DataError.
std::optional<Holdout> score_holdout(const Map& map, const FrameSource& source,
                                     const std::vector<const SensorModel*>& sensor, std::int64_t last,
                                     ViewPredictor& predictor, const HoldoutPoses& poses, const Workers& workers);

}  // namespace ppm
