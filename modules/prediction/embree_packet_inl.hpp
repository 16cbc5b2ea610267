#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <embree3/rtcore.h>
#include <vector>

#include "framework/slam/prediction.hpp"
#include "modules/maps/ppm/visible_chunks.hpp"
#include "modules/prediction/embree_scene.hpp"
#include "modules/prediction/embree_view.hpp"

namespace ppm {

/// Embree's packet types under one face. A packet of a whole view is a small rectangle of pixels.
template <int N>
struct Packet;
template <>
struct Packet<1> {
  using RayHit = RTCRayHit;
  static constexpr int cols = 1, rows = 1;
  static void intersect(const int*, RTCScene s, RTCIntersectContext* c, RayHit* r) { rtcIntersect1(s, c, r); }
};
template <>
struct Packet<4> {
  using RayHit = RTCRayHit4;
  static constexpr int cols = 2, rows = 2;
  static void intersect(const int* v, RTCScene s, RTCIntersectContext* c, RayHit* r) { rtcIntersect4(v, s, c, r); }
};
template <>
struct Packet<8> {
  using RayHit = RTCRayHit8;
  static constexpr int cols = 4, rows = 2;
  static void intersect(const int* v, RTCScene s, RTCIntersectContext* c, RayHit* r) { rtcIntersect8(v, s, c, r); }
};
template <>
struct Packet<16> {
  using RayHit = RTCRayHit16;
  static constexpr int cols = 4, rows = 4;
  static void intersect(const int* v, RTCScene s, RTCIntersectContext* c, RayHit* r) { rtcIntersect16(v, s, c, r); }
};

/// A member of a packet type as an array: a single ray's members are scalars.
template <class T>
T* lanes(T& scalar) {
  return &scalar;
}
template <class T, std::size_t n>
T* lanes(T (&array)[n]) {
  return array;
}

/// Refuses hits whose geometric normal (right-hand rule over the face's winding) looks away from the ray's origin.
inline void refuse_back_faces(const RTCFilterFunctionNArguments* args) {
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    const float along = RTCHitN_Ng_x(args->hit, n, i) * RTCRayN_dir_x(args->ray, n, i) +
                        RTCHitN_Ng_y(args->hit, n, i) * RTCRayN_dir_y(args->ray, n, i) +
                        RTCHitN_Ng_z(args->hit, n, i) * RTCRayN_dir_z(args->ray, n, i);
    if (along >= 0.f) args->valid[i] = 0;
  }
}

/// N rays through pixels of a view, and the nearest hits that they have found. The same pixel gives the same ray and
/// hit whatever the others of its packet are.
template <int N>
class RayPacket {
 public:
  using P = Packet<N>;

  /// view: its camera and pose are read. scenes: see trace_hits(); kept by reference.
  RayPacket(const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options, const Prediction& view)
      : scenes_(scenes), cull_(options.cull_back_faces) {
    rtcInitIntersectContext(&context_);
    context_.flags = options.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    const Camera& camera = view.camera;
    const Eigen::Matrix3d R = view.T_map_camera.linear();
    per_x_ = (R.col(0) / camera.fx).cast<float>();
    per_y_ = (R.col(1) / camera.fy).cast<float>();
    corner_ = (R * camera.ray(0, 0)).cast<float>();
    const Eigen::Vector3f origin = view.T_map_camera.translation().cast<float>();
    auto& ray = packet_.ray;
    for (int i = 0; i < N; ++i) {
      lanes(ray.org_x)[i] = origin.x();
      lanes(ray.org_y)[i] = origin.y();
      lanes(ray.org_z)[i] = origin.z();
      lanes(ray.tnear)[i] = 0.f;
      lanes(ray.time)[i] = 0.f;
      lanes(ray.mask)[i] = 0xffffffffu;
      lanes(ray.id)[i] = 0;
      lanes(ray.flags)[i] = 0;
    }
  }

  int x[N], y[N];  ///< the pixels, to be set before trace()
  bool on[N];      ///< lanes that have a pixel
  // Where chunk is not kNone, the hit; see ElementHits.
  std::uint32_t chunk[N], face[N];
  float u[N], v[N], facing[N];
  float range(int lane) const { return lanes(packet_.ray.tfar)[lane]; }

  /// Traces through the chunks that may show in the pixels' rectangle, nearest box first.
  void trace(const std::vector<VisibleChunk>& chunks) {
    aim();
    int left = x[0], right = x[0], top = y[0], bottom = y[0];  // lane 0 is always on
    for (int i = 1; i < N; ++i) {
      if (!on[i]) continue;
      left = std::min(left, x[i]), right = std::max(right, x[i]);
      top = std::min(top, y[i]), bottom = std::max(bottom, y[i]);
    }
    const float* tfar = lanes(packet_.ray.tfar);
    for (const auto& c : chunks) {
      if (!c.meets(left, top, right, bottom)) continue;
      if (c.distance > largest(tfar)) break;  // nothing further can be nearer than the hits
      intersect(c.chunk);
    }
  }

 private:
  void aim() {
    float *dir_x = lanes(packet_.ray.dir_x), *dir_y = lanes(packet_.ray.dir_y), *dir_z = lanes(packet_.ray.dir_z);
    float* tfar = lanes(packet_.ray.tfar);
    for (int i = 0; i < N; ++i) {
      const auto px = static_cast<float>(x[i]), py = static_cast<float>(y[i]);
      const float dx = corner_.x() + px * per_x_.x() + py * per_y_.x();
      const float dy = corner_.y() + px * per_x_.y() + py * per_y_.y();
      const float dz = corner_.z() + px * per_x_.z() + py * per_y_.z();
      const float scale = 1.f / std::sqrt(dx * dx + dy * dy + dz * dz);
      dir_x[i] = dx * scale;
      dir_y[i] = dy * scale;
      dir_z[i] = dz * scale;
    }
    for (int i = 0; i < N; ++i) {
      valid_[i] = on[i] ? -1 : 0;
      tfar[i] = on[i] ? Prediction::kMiss : -1.f;
      chunk[i] = Prediction::kNone;
    }
  }

  static float largest(const float* values) {
    float reduced[N];
    std::copy(values, values + N, reduced);
    for (int width = N / 2; width > 0; width /= 2)
      for (int i = 0; i < width; ++i) reduced[i] = std::max(reduced[i], reduced[i + width]);
    return reduced[0];
  }

  // Traces the packet through a chunk. Few rays meet a back face first, so a filter of hits, which costs at every
  // candidate, is left to those.
  void intersect(std::uint32_t number) {
    unsigned* hit = lanes(packet_.hit.geomID);
    float* tfar = lanes(packet_.ray.tfar);
    float limit[N] = {};
    std::copy(tfar, tfar + N, limit);
    std::fill(hit, hit + N, RTC_INVALID_GEOMETRY_ID);
    P::intersect(valid_, scenes_[number]->handle(), &context_, &packet_);
    if (std::all_of(hit, hit + N, [](unsigned g) { return g == RTC_INVALID_GEOMETRY_ID; })) return;
    find_facing();
    alignas(64) int again[N] = {};
    bool any = false;
    for (int i = 0; i < N; ++i) {
      if (!cull_ || hit[i] == RTC_INVALID_GEOMETRY_ID || facing_now_[i] > 0) continue;
      again[i] = -1;
      any = true;
      tfar[i] = limit[i];
      hit[i] = RTC_INVALID_GEOMETRY_ID;
    }
    if (any) {
      context_.filter = refuse_back_faces;
      P::intersect(again, scenes_[number]->handle(), &context_, &packet_);
      context_.filter = nullptr;
      find_facing();
    }
    keep_hits(number);
  }

  // How far the hits of the chunk face their rays, see ElementHits. Lanes without a hit hold rubbish.
  void find_facing() {
    const float *nx = lanes(packet_.hit.Ng_x), *ny = lanes(packet_.hit.Ng_y), *nz = lanes(packet_.hit.Ng_z);
    const float *dx = lanes(packet_.ray.dir_x), *dy = lanes(packet_.ray.dir_y), *dz = lanes(packet_.ray.dir_z);
    for (int i = 0; i < N; ++i)
      facing_now_[i] = -(nx[i] * dx[i] + ny[i] * dy[i] + nz[i] * dz[i]) /
                       std::sqrt(nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i]);
  }

  // A later chunk may overwrite the packet's hits and then take them back.
  void keep_hits(std::uint32_t number) {
    const unsigned* hit = lanes(packet_.hit.geomID);
    for (int i = 0; i < N; ++i) {
      if (hit[i] == RTC_INVALID_GEOMETRY_ID) continue;
      chunk[i] = number;
      face[i] = lanes(packet_.hit.primID)[i];
      u[i] = lanes(packet_.hit.u)[i];
      v[i] = lanes(packet_.hit.v)[i];
      facing[i] = facing_now_[i];
    }
  }

  const std::vector<const EmbreeScene*>& scenes_;
  const bool cull_;
  RTCIntersectContext context_;
  Eigen::Vector3f corner_, per_x_, per_y_;  // direction of pixel (x, y) before it is unit: corner + x per_x + y per_y
  typename P::RayHit packet_;
  alignas(64) int valid_[N];
  float facing_now_[N];
};

}  // namespace ppm
