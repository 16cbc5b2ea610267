// Drawing of the faces that may cover a pixel: edge functions and plane of each, then the pixels.
#include <algorithm>
#include <cstring>

#include "modules/prediction/raster_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/prediction/raster_draw_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "modules/prediction/raster_lanes_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ppm {
namespace HWY_NAMESPACE {
namespace {

constexpr std::int32_t kFewPixels = 24;  // of a box: up to here, one pixel each of many faces at a time

struct Vec3 {
  VF x, y, w;
};
Vec3 sum(const Vec3& a, const Vec3& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.w, b.w)};
}
Vec3 difference(const Vec3& a, const Vec3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.w, b.w)};
}
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {hn::Sub(hn::Mul(a.y, b.w), hn::Mul(a.w, b.y)), hn::Sub(hn::Mul(a.w, b.x), hn::Mul(a.x, b.w)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
VF dot(const Vec3& a, const Vec3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.w, b.w));
}
Vec3 scaled(const Vec3& a, VF s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.w, s)};
}
Vec3 with_sign_of(VF s, const Vec3& a) {
  const VF sign = hn::And(s, hn::Set(df, -0.f));
  return {hn::Xor(a.x, sign), hn::Xor(a.y, sign), hn::Xor(a.w, sign)};
}

/// a x + (b y + c): the same operations wherever a pixel is decided, so that two faces of an edge agree about it.
VF at(const Vec3& line, VF x, VF y) {
  return hn::Add(hn::Mul(line.x, x), hn::Add(hn::Mul(line.y, y), line.w));
}

struct Triangles {
  Vec3 edge[3];  // twice v_j x v_k, positive inside
  Vec3 plane;    // 1 / depth
  VF scale, slope;
  MF drawn;
};

/// The product of an edge's ends as (a + b) x (b - a): small terms, and exactly negated for the face on its other side.
Vec3 edge_function(const Vec3& a, const Vec3& b) {
  return cross(sum(a, b), difference(b, a));
}

Triangles set_up(const RasterCamera& camera, const Vec3* v) {
  const Vec3 normal = cross(difference(v[1], v[0]), difference(v[2], v[0]));
  const VF volume = dot(normal, v[0]), front = hn::Mul(volume, hn::Set(df, camera.front));
  const VF inverse = hn::Div(hn::Set(df, 1.f), volume);
  Triangles t;
  for (int k = 0; k < 3; ++k) t.edge[k] = with_sign_of(volume, edge_function(v[(k + 1) % 3], v[(k + 2) % 3]));
  t.plane = scaled(normal, inverse);
  t.scale = hn::Mul(hn::Set(df, 0.5f), hn::Abs(inverse));
  const VF mx = hn::Mul(t.plane.x, hn::Set(df, camera.focal_x)), my = hn::Mul(t.plane.y, hn::Set(df, camera.focal_y));
  const VF mz = hn::Add(
      hn::Add(hn::Mul(t.plane.x, hn::Set(df, camera.offset_x)), hn::Mul(t.plane.y, hn::Set(df, camera.offset_y))),
      t.plane.w);
  const VF slope = hn::Sqrt(hn::Add(hn::Add(hn::Mul(mx, mx), hn::Mul(my, my)), hn::Mul(mz, mz)));
  t.slope = hn::CopySign(slope, front);
  const VF zero = hn::Zero(df);
  t.drawn = camera.cull ? hn::Gt(front, zero) : hn::Ne(front, zero);
  return t;
}

/// Which rows and columns a box covers, as image coordinates.
struct Boxes {
  VF x0, x1, y0, y1;
  VI pixels;
};

Boxes boxes_of(const RasterCamera& camera, const std::uint32_t* columns, const std::uint32_t* rows) {
  auto unpack = [](const std::uint32_t* packed, VI& first, VI& last) {
    const VU p = hn::LoadU(du, packed);
    first = hn::BitCast(di, hn::And(p, hn::Set(du, 0xffff)));
    last = hn::BitCast(di, hn::ShiftRight<16>(p));
  };
  VI x0, x1, y0, y1;
  unpack(columns, x0, x1);
  unpack(rows, y0, y1);
  const VI one = hn::Set(di, 1), mx = hn::Set(di, camera.middle_x), my = hn::Set(di, camera.middle_y);
  return {hn::ConvertTo(df, hn::Sub(x0, mx)), hn::ConvertTo(df, hn::Sub(x1, mx)), hn::ConvertTo(df, hn::Sub(y0, my)),
          hn::ConvertTo(df, hn::Sub(y1, my)), hn::Mul(hn::Add(hn::Sub(x1, x0), one), hn::Add(hn::Sub(y1, y0), one))};
}

template <class M>
std::uint32_t bits_of(M mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(df, mask, bytes);
  std::uint32_t bits;
  std::memcpy(&bits, bytes, 4);
  return bits;
}

class Band {
 public:
  Band(const RasterCamera& camera, RasterBand& band, float* inverse_depth)
      : camera_(camera), band_(band), shown_(band.shown.data()), depth_(inverse_depth) {
    for (int k = 0; k < 4; ++k) quad_[k] = band.quad[k].data();
  }

  void draw(const std::uint32_t* face, const float* vertex, const RasterBoxes& boxes, std::uint32_t slot) {
    const VF slots = hn::BitCast(df, hn::Set(du, slot));
    for (std::size_t i = 0; i < boxes.size; i += kLanes) {
      Vec3 v[3];
      load_corners(face, vertex, boxes.face.data() + i, std::min(kLanes, boxes.size - i), v);
      Triangles t = set_up(camera_, v);
      t.drawn = hn::And(t.drawn, hn::FirstN(df, boxes.size - i));
      const std::size_t first = band_.triangles;
      store(t, hn::BitCast(df, hn::LoadU(du, boxes.face.data() + i)), slots, first);
      band_.triangles += std::min(kLanes, boxes.size - i);
      const Boxes box = boxes_of(camera_, boxes.columns.data() + i, boxes.rows.data() + i);
      const MF few = hn::RebindMask(df, hn::Gt(hn::Set(di, kFewPixels + 1), box.pixels));
      draw_pixels(t, box, hn::And(few, t.drawn), static_cast<std::uint32_t>(first));
      for (std::uint32_t bits = bits_of(hn::AndNot(few, t.drawn)); bits != 0; bits &= bits - 1) {
        const std::size_t k = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
        draw_rows(first + k, boxes.columns.data()[i + k], boxes.rows.data()[i + k]);
      }
    }
  }

 private:
  static void load_corners(const std::uint32_t* face, const float* vertex, const std::uint32_t* chosen,
                           std::size_t count, Vec3* v) {
    alignas(64) float corner[3][4 * kLanes];
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        std::memcpy(&corner[k][4 * i], vertex + 4 * std::size_t{face[3 * std::size_t{chosen[i]} + k]}, 16);
    for (std::size_t i = count; i < kLanes; ++i)
      for (auto& c : corner) std::memset(&c[4 * i], 0, 16);
    VF unused;
    for (int k = 0; k < 3; ++k) hn::LoadInterleaved4(df, corner[k], v[k].x, v[k].y, v[k].w, unused);
  }

  void store(const Triangles& t, VF face, VF slot, std::size_t first) {
    hn::StoreInterleaved4(t.edge[1].x, t.edge[1].y, t.edge[1].w, t.scale, df, quad_[0] + 4 * first);
    hn::StoreInterleaved4(t.edge[2].x, t.edge[2].y, t.edge[2].w, t.slope, df, quad_[1] + 4 * first);
    hn::StoreInterleaved4(t.plane.x, t.plane.y, t.plane.w, face, df, quad_[2] + 4 * first);
    hn::StoreInterleaved4(t.edge[0].x, t.edge[0].y, t.edge[0].w, slot, df, quad_[3] + 4 * first);
  }

  /// One pixel of each box at a time: covered ones are listed, then shown.
  void draw_pixels(const Triangles& t, const Boxes& box, MF on, std::uint32_t first) {
    const VF one = hn::Set(df, 1.f), zero = hn::Zero(df), cols = hn::Set(df, static_cast<float>(camera_.cols));
    const VF origin =
        hn::Set(df, static_cast<float>((camera_.middle_y - camera_.first_row) * camera_.cols + camera_.middle_x));
    const VU triangle = hn::Iota(du, first);
    std::size_t listed = 0;
    VF x = box.x0, y = box.y0;
    while (!hn::AllFalse(df, on)) {
      const VF depth = at(t.plane, x, y);
      const MF inside = hn::And(hn::And(hn::Ge(at(t.edge[0], x, y), zero), hn::Ge(at(t.edge[1], x, y), zero)),
                                hn::And(hn::Ge(at(t.edge[2], x, y), zero), hn::Gt(depth, zero)));
      const MF covered = hn::And(inside, on);
      const VI pixel = hn::NearestInt(hn::Add(hn::Add(hn::Mul(y, cols), x), origin));
      hn::StoreU(hn::Compress(depth, covered), df, list_depth_ + listed);
      hn::StoreU(hn::Compress(pixel, hn::RebindMask(di, covered)), di, list_pixel_ + listed);
      hn::StoreU(hn::Compress(triangle, hn::RebindMask(du, covered)), du, list_triangle_ + listed);
      listed += hn::CountTrue(df, covered);
      x = hn::Add(x, one);
      const MF next_row = hn::Gt(x, box.x1);
      x = hn::IfThenElse(next_row, box.x0, x);
      y = hn::IfThenElse(next_row, hn::Add(y, one), y);
      on = hn::And(on, hn::Le(y, box.y1));
    }
    show_list(listed);
  }

  void show_list(std::size_t listed) {
    float* const depth = depth_;
    std::uint32_t* const shown = shown_;
    for (std::size_t i = 0; i < listed; ++i) {
      const auto pixel = static_cast<std::size_t>(list_pixel_[i]);
      const float inverse = list_depth_[i], old = depth[pixel];
      const std::uint32_t triangle = list_triangle_[i], other = shown[pixel];
      bool nearer = inverse > old;
      if (inverse == old) nearer = goes_first(triangle, other);
      depth[pixel] = nearer ? inverse : old;
      shown[pixel] = nearer ? triangle : other;
    }
  }

  /// Whether a triangle is shown before another at the same depth. Depends on the map alone.
  bool goes_first(std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t chunk_a = band_.texels_of(a).chunk, chunk_b = band_.texels_of(b).chunk;
    return chunk_a != chunk_b ? chunk_a < chunk_b : band_.face_of(a) < band_.face_of(b);
  }

  Vec3 line(int quad, std::size_t triangle) const {
    const float* q = quad_[quad] + 4 * triangle;
    return {hn::Set(df, q[0]), hn::Set(df, q[1]), hn::Set(df, q[2])};
  }

  /// Neighbouring pixels of one face at a time.
  void draw_rows(std::size_t triangle, std::uint32_t columns, std::uint32_t rows) {
    const Vec3 e0 = line(3, triangle), e1 = line(0, triangle), e2 = line(1, triangle), plane = line(2, triangle);
    const int x0 = static_cast<int>(columns & 0xffffu), x1 = static_cast<int>(columns >> 16);
    const VF first = hn::Iota(df, static_cast<float>(x0 - camera_.middle_x));
    const VF last = hn::Set(df, static_cast<float>(x1 - camera_.middle_x)), zero = hn::Zero(df);
    const VU id = hn::Set(du, static_cast<std::uint32_t>(triangle));
    for (int row = static_cast<int>(rows & 0xffffu); row <= static_cast<int>(rows >> 16); ++row) {
      const VF y = hn::Set(df, static_cast<float>(row - camera_.middle_y));
      std::size_t pixel = static_cast<std::size_t>(row - camera_.first_row) * static_cast<std::size_t>(camera_.cols) +
                          static_cast<std::size_t>(x0);
      VF x = first;
      for (int col = x0; col <= x1; col += static_cast<int>(kLanes), pixel += kLanes) {
        const VF depth = at(plane, x, y), old = hn::LoadU(df, depth_ + pixel);
        const MF inside = hn::And(hn::And(hn::Ge(at(e0, x, y), zero), hn::Ge(at(e1, x, y), zero)),
                                  hn::And(hn::Ge(at(e2, x, y), zero), hn::Le(x, last)));
        const MF seen = hn::And(inside, hn::And(hn::Ge(depth, old), hn::Gt(depth, zero)));
        x = hn::Add(x, hn::Set(df, static_cast<float>(kLanes)));
        if (hn::AllFalse(df, seen)) continue;
        const MF tied = hn::And(seen, hn::Eq(depth, old));
        if (!hn::AllFalse(df, tied)) show_tied(pixel, bits_of(tied), static_cast<std::uint32_t>(triangle));
        const MF nearer = hn::AndNot(tied, seen);
        hn::BlendedStore(depth, nearer, df, depth_ + pixel);
        hn::BlendedStore(id, hn::RebindMask(du, nearer), du, shown_ + pixel);
      }
    }
  }

  void show_tied(std::size_t pixel, std::uint32_t bits, std::uint32_t triangle) {
    for (; bits != 0; bits &= bits - 1) {
      std::uint32_t& shown = shown_[pixel + hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)];
      if (goes_first(triangle, shown)) shown = triangle;
    }
  }

  const RasterCamera& camera_;
  RasterBand& band_;
  std::uint32_t* shown_;
  float* depth_;
  float* quad_[4];
  // Pixels that the faces at hand cover.
  static constexpr std::size_t kMostListed = (kFewPixels + 1) * kLanes;
  alignas(64) float list_depth_[kMostListed];
  alignas(64) std::int32_t list_pixel_[kMostListed];
  alignas(64) std::uint32_t list_triangle_[kMostListed];
};

void draw(const RasterCamera& camera, const std::uint32_t* face, const float* vertex, const RasterBoxes& boxes,
          std::uint32_t slot, RasterBand& band, float* inverse_depth) {
  const std::size_t needed = 4 * (band.triangles + boxes.size + RasterBand::kSpare);
  for (auto& quad : band.quad) quad.reserve(needed, 4 * band.triangles);
  Band(camera, band, inverse_depth).draw(face, vertex, boxes, slot);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace ppm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ppm {
HWY_EXPORT(draw);

void raster_draw(const RasterCamera& camera, const std::uint32_t* face, const float* vertex, const RasterBoxes& boxes,
                 std::uint32_t slot, RasterBand& band, float* inverse_depth) {
  HWY_DYNAMIC_DISPATCH(draw)(camera, face, vertex, boxes, slot, band, inverse_depth);
}
}  // namespace ppm
#endif
