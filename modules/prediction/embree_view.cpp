#include "modules/prediction/embree_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <embree3/rtcore.h>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/color_sample.hpp"
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
  using P = Packet<N>;

 public:
  ViewTracer(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
             const Rows& rows, Prediction& out)
      : map_(map), scenes_(scenes), options_(options), rows_(rows), out_(out) {
    rtcInitIntersectContext(&context_);
    context_.flags = options.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    const Eigen::Matrix3d R = out.T_map_camera.linear();
    per_x_ = (R.col(0) / out.camera.fx).cast<float>();
    per_y_ = (R.col(1) / out.camera.fy).cast<float>();
    corner_ = (R * out.camera.ray(0, 0)).cast<float>();
    const Eigen::Vector3f origin = out.T_map_camera.translation().cast<float>();
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
    const Camera& camera = out_.camera;
    const auto visible = visible_chunks(map_, camera, out_.T_map_camera);
    std::vector<VisibleChunk> in_tile;
    for (int y = rows_.first; y < rows_.end; y += kTile)
      for (int x = 0; x < camera.cols; x += kTile) {
        in_tile.clear();
        for (const auto& v : visible)
          if (v.meets(x, y, x + kTile - 1, y + kTile - 1)) in_tile.push_back(v);
        if (!in_tile.empty()) trace_tile(x, y, in_tile);
      }
  }

 private:
  void trace_tile(int x0, int y0, const std::vector<VisibleChunk>& chunks) {
    for (int y = y0; y < std::min(y0 + kTile, rows_.end); y += P::rows)
      for (int x = x0; x < std::min(x0 + kTile, out_.camera.cols); x += P::cols) {
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
    const int right = out_.camera.cols - x, bottom = rows_.end - y;
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
    unsigned* hit = lanes(packet_.hit.geomID);
    for (const auto& c : chunks) {
      if (!c.meets(x, y, x + P::cols - 1, y + P::rows - 1)) continue;
      if (c.distance > largest(tfar)) break;  // nothing further can be nearer than the hits
      std::fill(hit, hit + N, RTC_INVALID_GEOMETRY_ID);
      P::intersect(valid_, scenes_[c.chunk]->handle(), &context_, &packet_);
      for (int i = 0; i < N; ++i)
        if (hit[i] != RTC_INVALID_GEOMETRY_ID) chunk_[i] = c.chunk;
    }
  }

  // Unit normals of the hits, turned towards the camera; side_: -1 where that turned them. Lanes without a hit hold
  // rubbish.
  void turn_normals() {
    float *nx = lanes(packet_.hit.Ng_x), *ny = lanes(packet_.hit.Ng_y), *nz = lanes(packet_.hit.Ng_z);
    const float *dx = lanes(packet_.ray.dir_x), *dy = lanes(packet_.ray.dir_y), *dz = lanes(packet_.ray.dir_z);
    for (int i = 0; i < N; ++i) {
      side_[i] = nx[i] * dx[i] + ny[i] * dy[i] + nz[i] * dz[i] > 0.f ? -1.f : 1.f;
      const float scale = side_[i] / std::sqrt(nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i]);
      nx[i] *= scale;
      ny[i] *= scale;
      nz[i] *= scale;
    }
  }

  void read_hits(int x, int y) {
    const auto& h = packet_.hit;
    turn_normals();
    for (int i = 0; i < N; ++i) {
      if (chunk_[i] == Prediction::kNone) continue;
      const auto p = static_cast<std::size_t>((y + i / P::cols) * out_.camera.cols + x + i % P::cols);
      const std::uint32_t f = lanes(h.primID)[i];
      const float u = lanes(h.u)[i], v = lanes(h.v)[i];
      const PpmChunk& chunk = map_.table()[chunk_[i]];
      const TexelSample texel = options_.linear_texels ? linear_sample(*chunk.geometry, *chunk.texels, f, u, v)
                                                       : nearest_sample(*chunk.geometry, *chunk.texels, f, u, v);
      out_.range[p] = lanes(packet_.ray.tfar)[i];
      out_.mean[p] = side_[i] * texel.mean;  // along the turned normal
      out_.variance[p] = texel.variance;
      out_.normal[3 * p] = lanes(h.Ng_x)[i];
      out_.normal[3 * p + 1] = lanes(h.Ng_y)[i];
      out_.normal[3 * p + 2] = lanes(h.Ng_z)[i];
      out_.chunk[p] = chunk_[i];
      out_.face[p] = f;
      out_.bary[2 * p] = u;
      out_.bary[2 * p + 1] = v;
      if (out_.color_channels > 0) read_color(chunk, f, u, v, p);
    }
  }

  void read_color(const PpmChunk& chunk, std::uint32_t f, float u, float v, std::size_t p) {
    const ColorSample color = options_.linear_texels ? linear_color(*chunk.geometry, *chunk.texels, f, u, v)
                                                     : nearest_color(*chunk.geometry, *chunk.texels, f, u, v);
    const auto n = static_cast<std::size_t>(out_.color_channels);
    std::copy_n(color.mean.begin(), n, &out_.color[n * p]);
    out_.color_variance[p] = color.variance;
  }

  const PpmMap& map_;
  const std::vector<const EmbreeScene*>& scenes_;
  const EmbreeViewOptions& options_;
  const Rows rows_;
  Prediction& out_;
  RTCIntersectContext context_;
  Eigen::Vector3f corner_, per_x_,
      per_y_;                    // direction of pixel (x, y) before it is made unit: corner + x per_x + y per_y
  float lane_x_[N], lane_y_[N];  // pixels of a packet from its first
  typename P::RayHit packet_;
  alignas(64) int valid_[N];
  float side_[N];
  std::uint32_t chunk_[N];
};

}  // namespace

void trace_view(const PpmMap& map, const std::vector<const EmbreeScene*>& scenes, const EmbreeViewOptions& options,
                const Rows& rows, Prediction& out) {
  PPM_CHECK(out.color_channels == 0 || out.color_channels == map.color_channels(),
            "a view with {} channels of colour of a map with {}", out.color_channels, map.color_channels());
  switch (options.packet) {
    case 1:
      return ViewTracer<1>(map, scenes, options, rows, out).trace();
    case 4:
      return ViewTracer<4>(map, scenes, options, rows, out).trace();
    case 8:
      return ViewTracer<8>(map, scenes, options, rows, out).trace();
    case 16:
      return ViewTracer<16>(map, scenes, options, rows, out).trace();
    default:
      PPM_CHECK(false, "packets of {} rays", options.packet);
  }
}

}  // namespace ppm
