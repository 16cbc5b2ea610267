#include "modules/prediction/embree_view.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/maps/ppm/texel_sample.hpp"
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

template <int N>
class ViewTracer {
 public:
  ViewTracer(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
             Prediction& out)
      : map_(map), scenes_(scenes), options_(options), out_(out) {
    rtcInitIntersectContext(&context_);
    context_.flags = options.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    const Eigen::Matrix3d R = out.T_map_camera.linear();
    origin_ = out.T_map_camera.translation().cast<float>();
    per_x_ = (R.col(0) / out.camera.fx).cast<float>();
    per_y_ = (R.col(1) / out.camera.fy).cast<float>();
    corner_ = (R * out.camera.ray(0, 0)).cast<float>();
  }

  void trace() {
    const Camera& camera = out_.camera;
    const auto visible = visible_chunks(map_, camera, out_.T_map_camera);
    std::vector<VisibleChunk> in_tile;
    for (int y = 0; y < camera.rows; y += kTile)
      for (int x = 0; x < camera.cols; x += kTile) {
        in_tile.clear();
        for (const auto& v : visible)
          if (v.meets(x, y, x + kTile - 1, y + kTile - 1)) in_tile.push_back(v);
        if (!in_tile.empty()) trace_tile(x, y, in_tile);
      }
  }

 private:
  using P = Packet<N>;

  void trace_tile(int x0, int y0, const std::vector<VisibleChunk>& chunks) {
    for (int y = y0; y < std::min(y0 + kTile, out_.camera.rows); y += P::rows)
      for (int x = x0; x < std::min(x0 + kTile, out_.camera.cols); x += P::cols) {
        start(x, y);
        intersect(x, y, chunks);
        read_hits();
      }
  }

  // Sets up the rays of the packet whose first pixel is (x, y); lanes outside the image are off.
  void start(int x, int y) {
    auto& ray = packet_.ray;
    for (int i = 0; i < N; ++i) {
      const int px = x + i % P::cols, py = y + i / P::cols;
      const bool inside = px < out_.camera.cols && py < out_.camera.rows;
      valid_[i] = inside ? -1 : 0;
      pixel_[i] = static_cast<std::size_t>(py) * static_cast<std::size_t>(out_.camera.cols) + static_cast<std::size_t>(px);
      const Eigen::Vector3f d =
          (corner_ + static_cast<float>(px) * per_x_ + static_cast<float>(py) * per_y_).normalized();
      lanes(ray.org_x)[i] = origin_.x();
      lanes(ray.org_y)[i] = origin_.y();
      lanes(ray.org_z)[i] = origin_.z();
      lanes(ray.dir_x)[i] = d.x();
      lanes(ray.dir_y)[i] = d.y();
      lanes(ray.dir_z)[i] = d.z();
      lanes(ray.tnear)[i] = 0.f;
      lanes(ray.tfar)[i] = inside ? Prediction::kMiss : -1.f;
      lanes(ray.time)[i] = 0.f;
      lanes(ray.mask)[i] = 0xffffffffu;
      lanes(ray.id)[i] = 0;
      lanes(ray.flags)[i] = 0;
      chunk_[i] = Prediction::kNone;
    }
  }

  void intersect(int x, int y, const std::vector<VisibleChunk>& chunks) {
    const float* tfar = lanes(packet_.ray.tfar);
    unsigned* hit = lanes(packet_.hit.geomID);
    for (const auto& c : chunks) {
      if (!c.meets(x, y, x + P::cols - 1, y + P::rows - 1)) continue;
      if (c.distance > *std::max_element(tfar, tfar + N)) break;  // nothing further can be nearer than the hits
      std::fill(hit, hit + N, RTC_INVALID_GEOMETRY_ID);
      P::intersect(valid_, scenes_[c.chunk]->handle(), &context_, &packet_);
      for (int i = 0; i < N; ++i)
        if (hit[i] != RTC_INVALID_GEOMETRY_ID) chunk_[i] = c.chunk;
    }
  }

  void read_hits() {
    const auto& h = packet_.hit;
    for (int i = 0; i < N; ++i) {
      if (chunk_[i] == Prediction::kNone) continue;
      const std::size_t p = pixel_[i];
      const std::uint32_t f = lanes(h.primID)[i];
      const float u = lanes(h.u)[i], v = lanes(h.v)[i];
      const PpmChunk& chunk = map_.table()[chunk_[i]];
      const TexelSample texel = options_.linear_texels ? linear_sample(*chunk.geometry, *chunk.texels, f, u, v)
                                                       : nearest_sample(*chunk.geometry, *chunk.texels, f, u, v);
      Eigen::Vector3f n = Eigen::Vector3f(lanes(h.Ng_x)[i], lanes(h.Ng_y)[i], lanes(h.Ng_z)[i]).normalized();
      const Eigen::Vector3f d(lanes(packet_.ray.dir_x)[i], lanes(packet_.ray.dir_y)[i], lanes(packet_.ray.dir_z)[i]);
      const float side = n.dot(d) > 0.f ? -1.f : 1.f;  // a face seen from behind: its normal turns, and with it the mean's sign
      n *= side;
      out_.range[p] = lanes(packet_.ray.tfar)[i];
      out_.mean[p] = side * texel.mean;
      out_.variance[p] = texel.variance;
      for (int k = 0; k < 3; ++k) out_.normal[3 * p + static_cast<std::size_t>(k)] = n[k];
      out_.chunk[p] = chunk_[i];
      out_.face[p] = f;
      out_.bary[2 * p] = u;
      out_.bary[2 * p + 1] = v;
    }
  }

  const PpmMap& map_;
  const std::vector<const EmbreeScene*>& scenes_;
  const EmbreeViewOptions& options_;
  Prediction& out_;
  RTCIntersectContext context_;
  Eigen::Vector3f origin_, corner_, per_x_, per_y_;  // direction of pixel (x, y) before it is made unit: corner + x per_x + y per_y
  typename P::RayHit packet_;
  alignas(64) int valid_[N];
  std::size_t pixel_[N];
  std::uint32_t chunk_[N];
};

}  // namespace

void trace_view(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
                Prediction& out) {
  switch (options.packet) {
    case 1: return ViewTracer<1>(map, scenes, options, out).trace();
    case 4: return ViewTracer<4>(map, scenes, options, out).trace();
    case 8: return ViewTracer<8>(map, scenes, options, out).trace();
    case 16: return ViewTracer<16>(map, scenes, options, out).trace();
    default: PPM_CHECK(false, "packets of {} rays", options.packet);
  }
}

}  // namespace ppm
