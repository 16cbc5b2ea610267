#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/slam/frame_sequence.hpp"
#include "framework/slam/trajectory.hpp"
#include "modules/sources/camera_path.hpp"
#include "modules/sources/mesh_camera.hpp"
#include "modules/sources/mesh_rays.hpp"

namespace ppm {

/// What a simulated camera goes through: where it is when, and what its other sensors say on the way.
struct CameraJourney {
  std::vector<StampedPose> poses;  ///< T_world_camera of each image, stamps ascending
  std::vector<ImuSample> imu;      ///< ascending; empty: no inertial unit
  std::vector<Pose> T_odom_base;   ///< of each image; empty: no odometry
};

/// Poses of a path at `rate` a second, from its start to its end; at most `frames` of them where that is not negative.
std::vector<StampedPose> sampled(const CameraPath& path, double rate_Hz, std::int64_t frames);

/// The images that a simulated camera takes of a mesh. The moving body is the camera.
class MeshSequence final : public FrameSequence {
 public:
  MeshSequence(std::string name, TriangleMesh mesh, const MeshCamera& camera, std::uint64_t seed, CameraJourney journey);

  std::string name() const override { return name_; }
  std::int64_t size() const override { return static_cast<std::int64_t>(journey_.poses.size()); }
  double stamp_s(std::int64_t index) const override { return at(index).stamp_s; }
  std::optional<Pose> reference_pose(std::int64_t index) const override { return at(index).T_map_camera; }
  Frame read(std::int64_t index) const override;
  void add_motion(double after_s, Frame& image) const override;
  std::unique_ptr<const TrueSurface> true_surface() const override;

 private:
  const StampedPose& at(std::int64_t index) const { return journey_.poses.at(static_cast<std::size_t>(index)); }

  std::string name_;
  TriangleMesh mesh_;
  MeshRays rays_;
  MeshCamera camera_;
  std::uint64_t seed_;
  CameraJourney journey_;
};

}  // namespace ppm
