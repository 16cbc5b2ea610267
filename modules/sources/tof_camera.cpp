#include "modules/sources/tof_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/core/rng.hpp"

namespace ppm {
namespace {

/// What a ray brings back.
struct Echo {
  TofEcho light;
  SceneHit hit;
  Eigen::Vector3f color = Eigen::Vector3f::Zero();  // linear light
};

/// Light for pictures: of a lamp below the ceiling, and some from all around, more from above.
Eigen::Vector3f lit(const Eigen::Vector3f& albedo, const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
  const double lamp = std::max(0.0, normal.dot((Eigen::Vector3d(0, 0.3, 2.3) - p).normalized()));
  return albedo * static_cast<float>(0.40 + 0.10 * normal.z() + 0.50 * lamp);
}

Echo echo(const AnalyticScene& scene, const SceneHit& hit, const Eigen::Vector3d& origin,
          const Eigen::Vector3d& direction, bool color) {
  if (hit.solid == SceneHit::kNone) return {};
  const Solid& solid = scene.solids()[hit.solid];
  Echo e{TofSignal::echo(solid.albedo.mean(), -hit.normal.dot(direction), hit.range_m), hit, {}};
  const Eigen::Vector3d p = origin + hit.range_m * direction;
  if (color) e.color = lit(albedo_at(solid, p), p, hit.normal);
  return e;
}

/// One image being made.
class Exposure {
 public:
  Exposure(const TofCamera& tof, const AnalyticScene& scene, const Pose& T_world_camera)
      : tof_(tof), scene_(scene), T_(T_world_camera), cols_(tof.camera.cols), rows_(tof.camera.rows) {
    echoes_.reserve(static_cast<std::size_t>(tof.camera.pixels()));
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < cols_; ++x) {
        const Eigen::Vector3d d = ray(x, y);
        echoes_.push_back(echo(scene_, scene_.cast(T_.translation(), d), T_.translation(), d, tof_.color));
      }
  }
  /// What the pixel's whole area brings back: a phasor sum where more than one surface is in it.
  Echo pixel(int x, int y) const {
    const Echo& centre = at(x, y);
    return tof_.flying_pixels && on_edge(x, y) ? mixed(x, y, centre) : centre;
  }

 private:
  const Echo& at(int x, int y) const { return echoes_[static_cast<std::size_t>(y * cols_ + x)]; }
  Eigen::Vector3d ray(double x, double y) const { return T_.linear() * tof_.camera.ray(x, y).normalized(); }
  /// Calls f(x, y) for the pixel and those around it.
  template <class F>
  void around(int x, int y, F f) const {
    for (int v = std::max(0, y - 1); v <= std::min(rows_ - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(cols_ - 1, x + 1); ++u) f(u, v);
  }
  /// Whether a surface begins beside or within the pixel that does not lie in its centre's tangent plane. Creases,
  /// where the ranges within a pixel differ little, do not count.
  bool on_edge(int x, int y) const {
    const SceneHit& hit = at(x, y).hit;
    const double plane = hit.normal.dot(ray(x, y)) * hit.range_m;
    bool edge = false;
    around(x, y, [&](int u, int v) {
      const SceneHit& beside = at(u, v).hit;
      if (!edge && beside.solid != hit.solid)
        edge = std::abs(plane / hit.normal.dot(ray(u, v)) - beside.range_m) > TofSignal::kEdge_m;
    });
    return edge;
  }
  /// The solids that are seen in the pixel or around it, each once.
  std::vector<std::uint32_t> seen_around(int x, int y) const {
    std::vector<std::uint32_t> seen;
    around(x, y, [&](int u, int v) {
      const std::uint32_t solid = at(u, v).hit.solid;
      if (solid != SceneHit::kNone && std::find(seen.begin(), seen.end(), solid) == seen.end()) seen.push_back(solid);
    });
    return seen;
  }
  /// Nine samples, which see what the centres around saw: a thing that no pixel's centre sees is too thin to count.
  Echo mixed(int x, int y, const Echo& centre) const {
    constexpr int kSamples = 9;
    const auto seen = seen_around(x, y);
    std::array<TofEcho, kSamples> parts;
    Echo sum{{}, centre.hit, Eigen::Vector3f::Zero()};
    for (int k = 0; k < kSamples; ++k) {
      const Eigen::Vector3d d = ray(x + (k % 3 - 1) / 3.0, y + (k / 3 - 1) / 3.0);
      const Echo e = echo(scene_, scene_.cast_among(seen, T_.translation(), d), T_.translation(), d, tof_.color);
      parts[static_cast<std::size_t>(k)] = e.light;
      sum.color += e.color / kSamples;
    }
    sum.light = TofSignal::mixed(parts);
    return sum;
  }

  const TofCamera& tof_;
  const AnalyticScene& scene_;
  const Pose& T_;
  int cols_, rows_;
  std::vector<Echo> echoes_;  // of the pixels' centres
};

void append_srgb(const Eigen::Vector3f& linear, std::vector<std::uint8_t>& out) {
  for (int k = 0; k < 3; ++k)
    out.push_back(static_cast<std::uint8_t>(std::lround(255 * std::pow(std::clamp(linear[k], 0.0f, 1.0f), 1 / 2.2f))));
}

}  // namespace

void TofCamera::render(const AnalyticScene& scene, const Pose& T_world_camera, std::uint64_t seed, Frame& frame) const {
  const Exposure exposure(*this, scene, T_world_camera);
  const auto n = static_cast<std::size_t>(camera.pixels());
  frame.camera = camera;
  frame.depth.assign(n, std::numeric_limits<float>::quiet_NaN());
  frame.sigma.assign(n, std::numeric_limits<float>::quiet_NaN());
  frame.color.clear();
  const std::uint32_t purpose = purpose_key("tof_camera/noise");
  for (int y = 0; y < camera.rows; ++y) {
    Rng rng(seed, static_cast<std::uint32_t>(frame.index), static_cast<std::uint32_t>(y), purpose);
    for (int x = 0; x < camera.cols; ++x) {
      const Echo e = exposure.pixel(x, y);
      if (color) append_srgb(e.color, frame.color);
      const auto reading = read(e.light, rng);
      if (!reading) continue;
      const double z_per_range = 1 / camera.ray(x, y).norm();
      const auto i = static_cast<std::size_t>(y * camera.cols + x);
      frame.depth[i] = static_cast<float>(reading->range_m * z_per_range);
      frame.sigma[i] = static_cast<float>(reading->sigma_m * z_per_range);
    }
  }
}

}  // namespace ppm
