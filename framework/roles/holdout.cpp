#include "framework/roles/holdout.hpp"

#include <algorithm>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

/// Stamps and poses written as text and read again differ by this much: s, m, rad.
constexpr double kSameStamp = 1e-6, kSamePose = 1e-7;

/// Estimated and reference pose of one frame.
struct Pair {
  Pose estimated, reference;
};

/// The first pose that is not earlier than a stamp, but for rounding.
std::vector<StampedPose>::const_iterator first_from(const std::vector<StampedPose>& path, double stamp_s) {
  return std::ranges::lower_bound(path, stamp_s - kSameStamp, {}, &StampedPose::stamp_s);
}

std::optional<Pose> pose_at(const std::vector<StampedPose>& path, double stamp_s) {
  const auto at = first_from(path, stamp_s);
  if (at == path.end() || at->stamp_s > stamp_s + kSameStamp) return std::nullopt;
  return at->T_map_camera;
}

std::optional<Pose> pose_between(const std::vector<StampedPose>& path, double stamp_s) {
  if (const auto exact = pose_at(path, stamp_s)) return exact;
  const auto after = first_from(path, stamp_s);
  if (after == path.begin() || after == path.end()) return std::nullopt;
  const auto before = after - 1;
  const double t = (stamp_s - before->stamp_s) / (after->stamp_s - before->stamp_s);
  return interpolate(before->T_map_camera, after->T_map_camera, t);
}

std::vector<Pair> pairs_of(const std::vector<StampedPose>& path, const std::vector<StampedPose>& reference) {
  std::vector<Pair> pairs;
  auto at = reference.begin();
  for (const auto& p : path) {
    while (at != reference.end() && at->stamp_s < p.stamp_s - kSameStamp) ++at;
    if (at != reference.end() && at->stamp_s <= p.stamp_s + kSameStamp)
      pairs.push_back({p.T_map_camera, at->T_map_camera});
  }
  return pairs;
}

bool is_same(const Pair& pair) {
  return are_near(pair.reference, pair.estimated, kSamePose, kSamePose);
}

/// T_map_ref. Source of the mean of rotations: Hartley et al., "Rotation averaging", IJCV 2013, section 5.3.
Pose align_poses(const std::vector<Pair>& pairs) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const auto& p : pairs) sum.topLeftCorner<3, 3>() += p.estimated.linear() * p.reference.linear().transpose();
  Pose T_map_ref = orthonormalized(sum);
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (const auto& p : pairs) offset += p.estimated.translation() - T_map_ref.linear() * p.reference.translation();
  T_map_ref.translation() = offset / static_cast<double>(pairs.size());
  return T_map_ref;
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
  view.prediction.reset(DepthScorer::sampling_camera(view.frame.camera, kHoldoutStep), 1, *pose,
                        map.color_channels());
  predictor.predict_all(map, view.prediction, worker);
}

}  // namespace

Pose map_from_reference(const std::vector<StampedPose>& path, const std::vector<StampedPose>& reference) {
  const auto pairs = pairs_of(path, reference);
  if (pairs.empty()) throw DataError("the trajectory", "none of its poses has a reference pose");
  const bool same = pairs.size() == path.size() && std::ranges::all_of(pairs, is_same);
  return same ? Pose::Identity() : align_poses(pairs);
}

HoldoutPoses reference_poses(const std::vector<StampedPose>& path, const std::vector<StampedPose>& reference) {
  const Pose T_map_ref = map_from_reference(path, reference);
  const bool same = T_map_ref.matrix() == Pose::Identity().matrix();
  return {same ? kReferencePoses : "reference, aligned", [T_map_ref](const Frame& f) -> std::optional<Pose> {
            if (!f.T_world_camera_ref) return std::nullopt;
            return T_map_ref * *f.T_world_camera_ref;
          }};
}

HoldoutPoses estimated_poses(std::vector<StampedPose> path, bool followed) {
  const auto find = followed ? pose_at : pose_between;
  return {followed ? "estimated" : "estimated, between neighbours",
          [path = std::move(path), find](const Frame& f) { return find(path, f.stamp_s); }};
}

std::optional<Holdout> score_holdout(const Map& map, const FrameSource& source,
                                     const std::vector<const SensorModel*>& sensor, std::int64_t last,
                                     ViewPredictor& predictor, const HoldoutPoses& poses, const Workers& workers) {
  std::vector<std::int64_t> indices;
  for (auto i : source.held_out())
    if (i <= last) indices.push_back(i);
  if (indices.empty()) return std::nullopt;

  predictor.prepare({&map}, workers);
  DepthScorer scorer;
  ColorScorer color;
  Holdout result;
  result.poses = poses.name;
  // In batches: images are read and predicted in parallel, and scored in order.
  std::vector<View> batch(2 * static_cast<std::size_t>(workers.threads()));
  for (std::size_t first = 0; first < indices.size(); first += batch.size()) {
    const std::size_t n = std::min(batch.size(), indices.size() - first);
    workers.for_each(n, [&](std::size_t i, int worker) {
      batch[i].frame = source.full_frame(indices[first + i]);
      for (const auto* model : sensor) model->set_noise(batch[i].frame);
      look(map, predictor, poses, batch[i], worker);
    });
    for (std::size_t i = 0; i < n; ++i) {
      if (!batch[i].has_pose) continue;
      DepthScorer of_frame;
      of_frame.add(batch[i].frame, batch[i].prediction, kHoldoutStep);
      if (!of_frame.empty()) result.by_frame.push_back({indices[first + i], of_frame.score()});
      scorer.add(of_frame);
      if (batch[i].prediction.color_channels > 0 && !batch[i].frame.color.empty())
        color.add(batch[i].frame, batch[i].prediction, kHoldoutStep);
      ++result.frames;
    }
  }
  if (result.frames == 0) return std::nullopt;
  result.score = scorer.score();
  if (!color.empty()) result.color = color.score();
  return result;
}

}  // namespace ppm
