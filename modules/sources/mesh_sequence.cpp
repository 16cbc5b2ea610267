#include "modules/sources/mesh_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ppm {

MeshSequence::MeshSequence(std::string name, const TriangleMesh& mesh, const MeshCamera& camera, std::uint64_t seed,
                           std::vector<StampedPose> poses)
    : name_(std::move(name)), mesh_(mesh), camera_(camera), seed_(seed), poses_(std::move(poses)) {}

Frame MeshSequence::read(std::int64_t index) const {
  Frame frame;
  frame.index = index;
  frame.stamp_s = stamp_s(index);
  frame.T_world_camera_ref = reference_pose(index);
  camera_.render(mesh_, *frame.T_world_camera_ref, seed_, frame);
  return frame;
}

std::vector<StampedPose> sampled(const CameraPath& path, double rate_Hz, std::int64_t frames) {
  const auto whole = static_cast<std::int64_t>(std::floor(path.duration_s() * rate_Hz)) + 1;
  const std::int64_t n = frames < 0 ? whole : std::min(frames, whole);
  std::vector<StampedPose> poses;
  for (std::int64_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / rate_Hz;
    poses.push_back({i, t, path.at(t).T_world_camera});
  }
  return poses;
}

}  // namespace ppm
