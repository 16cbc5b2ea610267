#include "modules/prediction/embree_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <embree3/rtcore.h>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/maps/ppm/visible_chunks.hpp"

namespace ppm {
namespace {

constexpr int kTile = 16;  // px: chunks are sorted out for a tile first, then for each packet in it

// Embree's packet types under one face. A packet is a small rectangle of pixels.
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

// A member of a packet type as an array: a single ray's members are scalars.
template <class T>
T* lanes(T& scalar) {
  return &scalar;
}
template <class T, std::size_t n>
T* lanes(T (&array)[n]) {
  return array;
}

// Refuses hits whose geometric normal (right-hand rule over the face's winding) looks away from the ray's origin.
void refuse_back_faces(const RTCFilterFunctionNArguments* args) {
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    const float along = RTCHitN_Ng_x(args->hit, n, i) * RTCRayN_dir_x(args->ray, n, i) +
                        RTCHitN_Ng_y(args->hit, n, i) * RTCRayN_dir_y(args->ray, n, i) +
                        RTCHitN_Ng_z(args->hit, n, i) * RTCRayN_dir_z(args->ray, n, i);
    if (along >= 0.f) args->valid[i] = 0;
  }
}

template <int N>
class ViewTracer {
  using P = Packet<N>;

 public:
  ViewTracer(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
             const Rows& rows, const Prediction& view, ElementHits& hits)
      : map_(map), scenes_(scenes), options_(options), rows_(rows), view_(view), camera_(view.camera), hits_(hits) {
    rtcInitIntersectContext(&context_);
    context_.flags = options.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    const Eigen::Matrix3d R = view.T_map_camera.linear();
    per_x_ = (R.col(0) / camera_.fx).cast<float>();
    per_y_ = (R.col(1) / camera_.fy).cast<float>();
    corner_ = (R * camera_.ray(0, 0)).cast<float>();
    const Eigen::Vector3f origin = view.T_map_camera.translation().cast<float>();
    auto& ray = packet_.ray;
    for (int i = 0; i < N; ++i) {
      lane_x_[i] = static_cast<float>(i % P::cols);
      lane_y_[i] = static_cast<float>(i / P::cols);
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

  void trace() {
    const auto visible = visible_chunks(map_, camera_, view_.T_map_camera);
    std::vector<VisibleChunk> in_tile;
    for (int y = rows_.first; y < rows_.end; y += kTile)
      for (int x = 0; x < camera_.cols; x += kTile) {
        in_tile.clear();
        for (const auto& v : visible)
          if (v.meets(x, y, x + kTile - 1, y + kTile - 1)) in_tile.push_back(v);
        if (!in_tile.empty()) trace_tile(x, y, in_tile);
      }
  }

 private:
  void trace_tile(int x0, int y0, const std::vector<VisibleChunk>& chunks) {
    for (int y = y0; y < std::min(y0 + kTile, rows_.end); y += P::rows)
      for (int x = x0; x < std::min(x0 + kTile, camera_.cols); x += P::cols) {
        start(x, y);
        intersect(x, y, chunks);
        read_hits(x, y);
      }
  }

  // Points the rays at the packet's pixels, of which (x, y) is the first; lanes outside the image are off.
  void start(int x, int y) {
    float *dir_x = lanes(packet_.ray.dir_x), *dir_y = lanes(packet_.ray.dir_y), *dir_z = lanes(packet_.ray.dir_z);
    float* tfar = lanes(packet_.ray.tfar);
    const Eigen::Vector3f first = corner_ + static_cast<float>(x) * per_x_ + static_cast<float>(y) * per_y_;
    for (int i = 0; i < N; ++i) {
      const float dx = first.x() + lane_x_[i] * per_x_.x() + lane_y_[i] * per_y_.x();
      const float dy = first.y() + lane_x_[i] * per_x_.y() + lane_y_[i] * per_y_.y();
      const float dz = first.z() + lane_x_[i] * per_x_.z() + lane_y_[i] * per_y_.z();
      const float scale = 1.f / std::sqrt(dx * dx + dy * dy + dz * dz);
      dir_x[i] = dx * scale;
      dir_y[i] = dy * scale;
      dir_z[i] = dz * scale;
    }
    const int right = camera_.cols - x, bottom = rows_.end - y;
    for (int i = 0; i < N; ++i) {
      const bool inside = i % P::cols < right && i / P::cols < bottom;
      valid_[i] = inside ? -1 : 0;
      tfar[i] = inside ? Prediction::kMiss : -1.f;
      chunk_[i] = Prediction::kNone;
    }
  }

  static float largest(const float* values) {
    float reduced[N];
    std::copy(values, values + N, reduced);
    for (int width = N / 2; width > 0; width /= 2)
      for (int i = 0; i < width; ++i) reduced[i] = std::max(reduced[i], reduced[i + width]);
    return reduced[0];
  }

  void intersect(int x, int y, const std::vector<VisibleChunk>& chunks) {
    const float* tfar = lanes(packet_.ray.tfar);
    for (const auto& c : chunks) {
      if (!c.meets(x, y, x + P::cols - 1, y + P::rows - 1)) continue;
      if (c.distance > largest(tfar)) break;  // nothing further can be nearer than the hits
      intersect_chunk(c.chunk);
    }
  }

  // Traces the packet through a chunk. Few rays meet a back face first, so a filter of hits, which costs at every
  // candidate, is left to those.
  void intersect_chunk(std::uint32_t chunk) {
    unsigned* hit = lanes(packet_.hit.geomID);
    float* tfar = lanes(packet_.ray.tfar);
    float limit[N];
    std::copy(tfar, tfar + N, limit);
    std::fill(hit, hit + N, RTC_INVALID_GEOMETRY_ID);
    P::intersect(valid_, scenes_[chunk]->handle(), &context_, &packet_);
    if (std::all_of(hit, hit + N, [](unsigned g) { return g == RTC_INVALID_GEOMETRY_ID; })) return;
    find_facing();
    alignas(64) int again[N] = {};
    bool any = false;
    for (int i = 0; i < N; ++i) {
      if (!options_.cull_back_faces || hit[i] == RTC_INVALID_GEOMETRY_ID || facing_now_[i] > 0) continue;
      again[i] = -1;
      any = true;
      tfar[i] = limit[i];
      hit[i] = RTC_INVALID_GEOMETRY_ID;
    }
    if (any) {
      context_.filter = refuse_back_faces;
      P::intersect(again, scenes_[chunk]->handle(), &context_, &packet_);
      context_.filter = nullptr;
      find_facing();
    }
    keep_hits(chunk);
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
  void keep_hits(std::uint32_t chunk) {
    const unsigned* hit = lanes(packet_.hit.geomID);
    for (int i = 0; i < N; ++i) {
      if (hit[i] == RTC_INVALID_GEOMETRY_ID) continue;
      chunk_[i] = chunk;
      face_[i] = lanes(packet_.hit.primID)[i];
      u_[i] = lanes(packet_.hit.u)[i];
      v_[i] = lanes(packet_.hit.v)[i];
      facing_[i] = facing_now_[i];
    }
  }

  // Copies the packet's hits to their pixels.
  void read_hits(int x, int y) {
    for (int i = 0; i < N; ++i) {
      if (chunk_[i] == Prediction::kNone) continue;
      const auto p = static_cast<std::size_t>((y + i / P::cols) * camera_.cols + x + i % P::cols);
      hits_.range[p] = lanes(packet_.ray.tfar)[i];
      hits_.u[p] = u_[i];
      hits_.v[p] = v_[i];
      hits_.facing[p] = facing_[i];
      hits_.chunk[p] = chunk_[i];
      hits_.face[p] = face_[i];
    }
  }

  const PpmMap& map_;
  const std::vector<const EmbreeScene*>& scenes_;
  const EmbreeViewOptions& options_;
  const Rows rows_;
  const Prediction& view_;
  const Camera& camera_;
  ElementHits& hits_;
  RTCIntersectContext context_;
  Eigen::Vector3f corner_, per_x_,
      per_y_;                    // direction of pixel (x, y) before it is made unit: corner + x per_x + y per_y
  float lane_x_[N], lane_y_[N];  // pixels of a packet from its first
  typename P::RayHit packet_;
  alignas(64) int valid_[N];
  float facing_now_[N];
  std::uint32_t chunk_[N], face_[N];  // the nearest hits so far
  float u_[N], v_[N], facing_[N];
};

}  // namespace

void trace_hits(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
                const Rows& rows, const Prediction& view, ElementHits& hits) {
  switch (options.packet) {
    case 1:
      return ViewTracer<1>(map, scenes, options, rows, view, hits).trace();
    case 4:
      return ViewTracer<4>(map, scenes, options, rows, view, hits).trace();
    case 8:
      return ViewTracer<8>(map, scenes, options, rows, view, hits).trace();
    case 16:
      return ViewTracer<16>(map, scenes, options, rows, view, hits).trace();
    default:
      PPM_CHECK(false, "packets of {} rays", options.packet);
  }
}

void trace_view(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
                const Rows& rows, Prediction& out) {
  ElementView view;
  view.start(map, options.linear_texels, static_cast<std::size_t>(out.camera.pixels()));
  trace_hits(map, scenes, options, rows, out, view.hits());
  view.fill(out, rows, out);
}

}  // namespace ppm
