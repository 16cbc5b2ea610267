#include "framework/roles/holdout.hpp"

#include <algorithm>

#include "framework/slam/trajectory_error.hpp"

namespace ppm {

namespace {

/// Poses written as text and read again differ by this much, m and rad.
constexpr double kSamePose = 1e-7;

/// True where the path consists of reference poses.
bool is_reference(const std::vector<StampedPose>& path, const std::vector<StampedPose>& reference) {
  auto at = reference.begin();
  for (const auto& p : path) {
    at = std::find_if(at, reference.end(), [&](const StampedPose& r) { return std::abs(r.stamp_s - p.stamp_s) < 1e-6; });
    if (at == reference.end()) return false;
    const Pose off = at->T_map_camera.inverse() * p.T_map_camera;
    if (off.translation().norm() > kSamePose || rotation_angle(off) > kSamePose) return false;
  }
  return !path.empty();
}

/// One held-out frame and what the map predicts of it.
struct View {
  Frame frame;
  Prediction prediction;
  bool has_pose = false;
};

void look(const Map& map, const ViewPredictor& predictor, const HoldoutPoses& poses, View& view, int worker) {
  const auto pose = poses.T_map_camera(view.frame);
  view.has_pose = pose.has_value();
  if (!pose) return;
  view.prediction.reset(DepthScorer::sampling_camera(view.frame.camera, kHoldoutStep), 1, *pose);
  predictor.predict(map, view.prediction, worker);
}

}  // namespace

HoldoutPoses reference_poses(const std::vector<StampedPose>& path, const std::vector<StampedPose>& reference) {
  if (is_reference(path, reference)) return {"reference", [](const Frame& f) { return f.T_world_camera_ref; }};
  const Pose T_map_ref = trajectory_error(path, reference).T_ref_est.inverse();
  return {"reference, aligned", [T_map_ref](const Frame& f) -> std::optional<Pose> {
            if (!f.T_world_camera_ref) return std::nullopt;
            return T_map_ref * *f.T_world_camera_ref;
          }};
}

HoldoutPoses estimated_poses(std::vector<StampedPose> path) {
  return {"estimated", [path = std::move(path)](const Frame& f) -> std::optional<Pose> {
            const auto after = std::find_if(path.begin(), path.end(), [&](const auto& p) { return p.stamp_s >= f.stamp_s; });
            if (after == path.end() || (after == path.begin() && after->stamp_s > f.stamp_s)) return std::nullopt;
            if (after == path.begin()) return after->T_map_camera;
            const auto before = after - 1;
            const double t = (f.stamp_s - before->stamp_s) / (after->stamp_s - before->stamp_s);
            return interpolate(before->T_map_camera, after->T_map_camera, t);
          }};
}

std::optional<Holdout> score_holdout(const Map& map, const FrameSource& source, std::int64_t last, ViewPredictor& predictor,
                                     const HoldoutPoses& poses, const Workers& workers) {
  std::vector<std::int64_t> indices;
  for (auto i : source.held_out())
    if (i <= last) indices.push_back(i);
  if (indices.empty()) return std::nullopt;

  predictor.prepare({&map}, workers);
  DepthScorer scorer;
  Holdout result;
  result.poses = poses.name;
  // In batches: images are read and predicted in parallel, and scored in order.
  std::vector<View> batch(2 * static_cast<std::size_t>(workers.threads()));
  for (std::size_t first = 0; first < indices.size(); first += batch.size()) {
    const std::size_t n = std::min(batch.size(), indices.size() - first);
    workers.for_each(n, [&](std::size_t i, int worker) {
      batch[i].frame = source.full_frame(indices[first + i]);
      look(map, predictor, poses, batch[i], worker);
    });
    for (std::size_t i = 0; i < n; ++i) {
      if (!batch[i].has_pose) continue;
      scorer.add(batch[i].frame, batch[i].prediction, kHoldoutStep);
      ++result.frames;
    }
  }
  if (result.frames == 0) return std::nullopt;
  result.score = scorer.score();
  return result;
}

}  // namespace ppm
