#include "modules/sources/mesh_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "framework/core/rng.hpp"
#include "framework/roles/frame_conditioning.hpp"

namespace ppm {
namespace {

constexpr double kKinectFocal_px = 585, kKinectBaseline_m = 0.075;
constexpr double kKinectLateral_px = 0.88;  // of an image with that focal length: see sensor.kinect
constexpr float kLeastCosine = 0.1f;

/// The hits of one image's rays.
class Exposure {
 public:
  Exposure(const MeshRays& mesh, const Camera& camera, const Pose& T_world_camera)
      : mesh_(mesh), camera_(camera), T_(T_world_camera) {
    const auto n = static_cast<std::size_t>(camera.pixels());
    direction_.reserve(n);
    hit_.resize(n);
  }
  /// The next pixel's ray goes through the image at (x, y).
  void aim(double x, double y) { direction_.push_back(ray(x, y)); }
  void aim_at_centres() {
    for (int y = 0; y < camera_.rows; ++y)
      for (int x = 0; x < camera_.cols; ++x) aim(x, y);
  }
  void cast() { mesh_.cast(T_.translation(), direction_, hit_); }

  const MeshHit& hit(int x, int y) const { return hit_[index(x, y)]; }
  float cosine(int x, int y) const { return -hit(x, y).normal.dot(direction_[index(x, y)]); }
  /// Depth per range of a pixel's ray.
  double z_per_range(int x, int y) const { return T_.linear().col(2).dot(direction_[index(x, y)].cast<double>()); }

  /// Whether a surface begins beside or within the pixel that does not lie in its centre's tangent plane.
  bool on_edge(int x, int y) const {
    const MeshHit& centre = hit(x, y);
    const float plane = cosine(x, y) * centre.range_m;
    for (int v = std::max(0, y - 1); v <= std::min(camera_.rows - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(camera_.cols - 1, x + 1); ++u) {
        const float beside = hit(u, v).range_m;
        if (std::isinf(beside) && std::isinf(centre.range_m)) continue;
        const float expected = plane / -centre.normal.dot(direction_[index(u, v)]);
        if (!(std::abs(expected - beside) <= TofSignal::kEdge_m)) return true;
      }
    return false;
  }
  /// Nine samples of the pixel's area.
  TofEcho mixed(int x, int y, double reflectance) const {
    constexpr std::size_t kSamples = 9;
    std::array<Eigen::Vector3f, kSamples> direction;
    std::array<MeshHit, kSamples> seen;
    std::array<TofEcho, kSamples> parts;
    for (int k = 0; k < static_cast<int>(kSamples); ++k)
      direction[static_cast<std::size_t>(k)] = ray(x + (k % 3 - 1) / 3.0, y + (k / 3 - 1) / 3.0);
    mesh_.cast(T_.translation(), direction, seen);
    for (std::size_t k = 0; k < kSamples; ++k) parts[k] = echo(seen[k], -seen[k].normal.dot(direction[k]), reflectance);
    return TofSignal::mixed(parts);
  }
  static TofEcho echo(const MeshHit& hit, float cosine, double reflectance) {
    return std::isinf(hit.range_m) ? TofEcho{} : TofSignal::echo(reflectance, cosine, hit.range_m);
  }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * camera_.cols + x); }
  Eigen::Vector3f ray(double x, double y) const {
    return (T_.linear() * camera_.ray(x, y)).normalized().cast<float>();
  }

  const MeshRays& mesh_;
  const Camera& camera_;
  const Pose& T_;
  std::vector<Eigen::Vector3f> direction_;
  std::vector<MeshHit> hit_;
};

/// Calls f(x, y, i, rng) for each pixel i; the stream of random numbers is the row's.
template <class F>
void each_pixel(const Camera& camera, std::uint64_t seed, std::int64_t frame, const char* purpose, F f) {
  const std::uint32_t key = purpose_key(purpose);
  for (int y = 0, i = 0; y < camera.rows; ++y) {
    Rng rng(seed, static_cast<std::uint32_t>(frame), static_cast<std::uint32_t>(y), key);
    for (int x = 0; x < camera.cols; ++x, ++i) f(x, y, static_cast<std::size_t>(i), rng);
  }
}

float quantised(double depth, double step) {
  if (step == 0) return static_cast<float>(depth);
  const double disparity = kKinectFocal_px * kKinectBaseline_m / depth;
  const double steps = std::max(1.0, std::round(disparity / step));
  return static_cast<float>(kKinectFocal_px * kKinectBaseline_m / (steps * step));
}

void read_exact(Exposure& exposure, Frame& frame) {
  exposure.aim_at_centres();
  exposure.cast();
  for (int y = 0, i = 0; y < frame.camera.rows; ++y)
    for (int x = 0; x < frame.camera.cols; ++x, ++i) {
      const float range = exposure.hit(x, y).range_m;
      if (std::isfinite(range))
        frame.depth[static_cast<std::size_t>(i)] = static_cast<float>(range * exposure.z_per_range(x, y));
    }
}

void read_kinect(Exposure& exposure, double step, std::uint64_t seed, Frame& frame) {
  const double lateral_px = kKinectLateral_px * std::abs(frame.camera.fx) / kKinectFocal_px;
  each_pixel(frame.camera, seed, frame.index, "mesh_camera/lateral", [&](int x, int y, std::size_t, Rng& rng) {
    const double dx = rng.normal(), dy = rng.normal();
    exposure.aim(x + lateral_px * dx, y + lateral_px * dy);
  });
  exposure.cast();
  const FrameConditioning axial;
  each_pixel(frame.camera, seed, frame.index, "mesh_camera/axial", [&](int x, int y, std::size_t i, Rng& rng) {
    const double noise = rng.normal();
    if (!(exposure.cosine(x, y) >= kLeastCosine)) return;
    const double z = exposure.hit(x, y).range_m * exposure.z_per_range(x, y);
    const double read = z + axial.sigma(z) * noise;
    if (read > 0) frame.depth[i] = quantised(read, step);
  });
}

void read_tof(Exposure& exposure, const TofSignal& tof, double reflectance, std::uint64_t seed, Frame& frame) {
  exposure.aim_at_centres();
  exposure.cast();
  frame.sigma.assign(frame.depth.size(), std::numeric_limits<float>::quiet_NaN());
  each_pixel(frame.camera, seed, frame.index, "mesh_camera/tof", [&](int x, int y, std::size_t i, Rng& rng) {
    const TofEcho echo = tof.flying_pixels && exposure.on_edge(x, y)
                             ? exposure.mixed(x, y, reflectance)
                             : Exposure::echo(exposure.hit(x, y), exposure.cosine(x, y), reflectance);
    const auto reading = tof.read(echo, rng);
    if (!reading || !(reading->range_m > 0)) return;
    frame.depth[i] = static_cast<float>(reading->range_m * exposure.z_per_range(x, y));
    frame.sigma[i] = static_cast<float>(reading->sigma_m * exposure.z_per_range(x, y));
  });
}

}  // namespace

void MeshCamera::render(const MeshRays& mesh, const Pose& T_world_camera, std::uint64_t seed, Frame& frame) const {
  frame.camera = camera;
  frame.depth.assign(static_cast<std::size_t>(camera.pixels()), std::numeric_limits<float>::quiet_NaN());
  frame.sigma.clear();
  Exposure exposure(mesh, frame.camera, T_world_camera);
  if (noise == Noise::exact) read_exact(exposure, frame);
  if (noise == Noise::kinect) read_kinect(exposure, disparity_step, seed, frame);
  if (noise == Noise::tof) read_tof(exposure, tof, reflectance, seed, frame);
}

}  // namespace ppm
