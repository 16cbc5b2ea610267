#include "modules/sources/mesh_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/slam/nearest_triangle.hpp"

namespace ppm {

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

namespace {

class MeshSurface final : public TrueSurface {
 public:
  MeshSurface(const TriangleMesh& mesh, const MeshRays& rays) : rays_(rays), triangles_(mesh.position, mesh.face) {}
  void cast(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3f> direction,
            std::span<float> range_m) const override {
    std::vector<MeshHit> hits(direction.size());
    rays_.cast(origin, direction, hits);
    std::ranges::transform(hits, range_m.begin(), &MeshHit::range_m);
  }
  double distance(const Eigen::Vector3d& p) const override { return triangles_.distance(p.cast<float>()); }

 private:
  const MeshRays& rays_;
  NearestTriangle triangles_;
};

}  // namespace

MeshSequence::MeshSequence(std::string name, TriangleMesh mesh, const MeshCamera& camera, std::uint64_t seed,
                           CameraJourney journey)
    : name_(std::move(name)), mesh_(std::move(mesh)), rays_(mesh_), camera_(camera), seed_(seed), journey_(std::move(journey)) {}

Frame MeshSequence::read(std::int64_t index) const {
  Frame frame;
  frame.index = index;
  frame.stamp_s = stamp_s(index);
  frame.T_world_camera_ref = reference_pose(index);
  camera_.render(rays_, *frame.T_world_camera_ref, seed_, frame);
  return frame;
}

std::unique_ptr<const TrueSurface> MeshSequence::true_surface() const {
  return std::make_unique<MeshSurface>(mesh_, rays_);
}

void MeshSequence::add_motion(double after_s, Frame& image) const {
  const auto later = [](double t, const ImuSample& s) { return t < s.stamp_s; };
  const auto first = std::upper_bound(journey_.imu.begin(), journey_.imu.end(), after_s, later);
  const auto last = std::upper_bound(first, journey_.imu.end(), image.stamp_s, later);
  image.imu.assign(first, last);
  if (!journey_.T_odom_base.empty()) image.T_odom_base = journey_.T_odom_base.at(static_cast<std::size_t>(image.index));
}

}  // namespace ppm
