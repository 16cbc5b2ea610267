#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/slam/frame_sequence.hpp"
#include "framework/slam/trajectory.hpp"
#include "modules/sources/camera_path.hpp"
#include "modules/sources/mesh_camera.hpp"
#include "modules/sources/mesh_rays.hpp"

namespace ppm {

/// The images that a simulated camera takes of a mesh, at given times and poses.
class MeshSequence final : public FrameSequence {
 public:
  /// poses: T_world_camera, their stamps ascending.
  MeshSequence(std::string name, const TriangleMesh& mesh, const MeshCamera& camera, std::uint64_t seed,
               std::vector<StampedPose> poses);

  std::string name() const override { return name_; }
  std::int64_t size() const override { return static_cast<std::int64_t>(poses_.size()); }
  double stamp_s(std::int64_t index) const override { return at(index).stamp_s; }
  std::optional<Pose> reference_pose(std::int64_t index) const override { return at(index).T_map_camera; }
  Frame read(std::int64_t index) const override;

 private:
  const StampedPose& at(std::int64_t index) const { return poses_.at(static_cast<std::size_t>(index)); }

  std::string name_;
  MeshRays mesh_;
  MeshCamera camera_;
  std::uint64_t seed_;
  std::vector<StampedPose> poses_;
};

/// Poses of a path at `rate` a second, from its start to its end; at most `frames` of them where that is not negative.
std::vector<StampedPose> sampled(const CameraPath& path, double rate_Hz, std::int64_t frames);

}  // namespace ppm
