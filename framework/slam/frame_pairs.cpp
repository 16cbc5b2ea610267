#include "framework/slam/frame_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ppm {
namespace {

constexpr std::size_t kEvery = 8;         // patch is looked at
constexpr double kLeastCosine = 0.7071;  // 45 degrees

using Placed = std::vector<std::vector<PlacedPatch>>;

/// Share of the patches of `from` that lie on one of `to`.
double share_on(const CalibrationFrame& from, const std::vector<PlacedPatch>& from_placed, const CalibrationFrame& to,
                const std::vector<PlacedPatch>& to_placed, const Camera& camera, double distance_m) {
  const Pose T = to.T_world_camera.inverse() * from.T_world_camera;
  std::size_t seen = 0, on = 0;
  for (std::size_t i = 0; i < from_placed.size(); i += kEvery, ++seen) {
    const Eigen::Vector3d q = T * from_placed[i].point;
    if (!(q.z() > 0)) continue;
    const Eigen::Vector2d pixel = camera.project(q);
    const int k = to.patches.around(pixel.x(), pixel.y());
    if (k < 0) continue;
    const Eigen::Vector3d& plane = to_placed[static_cast<std::size_t>(k)].plane;
    const Eigen::Vector3d normal = T.linear() * from_placed[i].plane;
    const double length = plane.norm();
    on += std::abs(plane.dot(q) - 1) < distance_m * length && normal.dot(plane) > kLeastCosine * length * normal.norm();
  }
  return seen == 0 ? 0 : static_cast<double>(on) / static_cast<double>(seen);
}

Placed place_all(const std::vector<CalibrationFrame>& frames, const CameraCorrection& correction) {
  Placed out;
  for (const auto& f : frames) {
    auto& patches = out.emplace_back();
    for (const auto& patch : f.patches.all) patches.push_back(placed(patch, f.patches.camera, correction));
  }
  return out;
}

double tilt(const Pose& a, const Pose& b) {
  return std::acos(std::clamp(a.linear().col(2).dot(b.linear().col(2)), -1.0, 1.0));
}

}  // namespace

std::vector<FramePair> overlapping_pairs(const std::vector<CalibrationFrame>& frames, const CameraCorrection& correction,
                                         double least_overlap, double distance_m, const Workers& workers) {
  const Placed patches = place_all(frames, correction);
  std::vector<std::vector<FramePair>> of(frames.size());
  workers.for_each(frames.size(), [&](std::size_t i, int) {
    const Camera camera = correction.camera(frames[i].patches.camera);
    for (std::size_t j = i + 1; j < frames.size(); ++j) {
      const Camera other = correction.camera(frames[j].patches.camera);
      double overlap = share_on(frames[i], patches[i], frames[j], patches[j], other, distance_m);
      if (overlap < least_overlap) continue;
      overlap = std::min(overlap, share_on(frames[j], patches[j], frames[i], patches[i], camera, distance_m));
      if (overlap < least_overlap) continue;
      of[i].push_back({i, j, overlap, tilt(frames[i].T_world_camera, frames[j].T_world_camera)});
    }
  });
  std::vector<FramePair> pairs;
  for (const auto& some : of) pairs.insert(pairs.end(), some.begin(), some.end());
  return pairs;
}

}  // namespace ppm
