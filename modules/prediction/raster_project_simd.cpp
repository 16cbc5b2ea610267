// What each vertex of a chunk is to a camera, and which faces of the chunk may cover a pixel.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "modules/prediction/raster_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/prediction/raster_project_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "modules/prediction/raster_lanes_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ppm {
namespace HWY_NAMESPACE {
namespace {

constexpr std::int32_t kUnknown = -32768;  // image coordinates that are too far off for 16 bits, or have no meaning
constexpr float kMostRounded = 32000;
constexpr float kLeastDepth = 1e-6f;  // m

struct Vertices {
  VF x, y, w;
};

VF row(const float* axes, VF x, VF y, VF z) {
  return hn::Add(hn::Add(hn::Mul(hn::Set(df, axes[0]), x), hn::Mul(hn::Set(df, axes[1]), y)),
                 hn::Mul(hn::Set(df, axes[2]), z));
}

VF relative(const RasterCamera& camera, int axis, VF p) {
  return hn::Sub(hn::Sub(p, hn::Set(df, camera.centre[axis])), hn::Set(df, camera.centre_rest[axis]));
}

VI rounded(const RasterCamera& camera, const Vertices& v) {
  const auto scale = hn::Set(df, static_cast<float>(1 << camera.fraction_bits));
  const auto per_w = hn::Div(scale, v.w);
  const auto x = hn::Mul(v.x, per_w), y = hn::Mul(v.y, per_w);
  const auto most = hn::Set(df, kMostRounded);
  const auto known =
      hn::And(hn::Gt(v.w, hn::Set(df, kLeastDepth)), hn::And(hn::Lt(hn::Abs(x), most), hn::Lt(hn::Abs(y), most)));
  const auto packed = hn::Or(hn::ShiftLeft<16>(hn::NearestInt(x)), hn::And(hn::NearestInt(y), hn::Set(di, 0xffff)));
  return hn::IfThenElse(hn::RebindMask(di, known), packed, hn::Set(di, kUnknown * 65536));
}

void project_lanes(const RasterCamera& camera, const float* position, float* vertex) {
  VF px, py, pz;
  hn::LoadInterleaved3(df, position, px, py, pz);
  px = relative(camera, 0, px);
  py = relative(camera, 1, py);
  pz = relative(camera, 2, pz);
  const Vertices v{row(camera.axes[0], px, py, pz), row(camera.axes[1], px, py, pz), row(camera.axes[2], px, py, pz)};
  hn::StoreInterleaved4(v.x, v.y, v.w, hn::BitCast(df, rounded(camera, v)), df, vertex);
}

void project(const RasterCamera& camera, const float* position, std::size_t count, float* vertex) {
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) project_lanes(camera, position + 3 * i, vertex + 4 * i);
  if (i == count) return;
  float rest[3 * kLanes] = {};
  std::copy(position + 3 * i, position + 3 * count, rest);
  project_lanes(camera, rest, vertex + 4 * i);
}

struct Box {
  VI x0, x1, y0, y1;
};

/// Pixels whose centres lie in a box of rounded image coordinates, grown by what rounding moves.
void pixels_of(VI least, VI most, int middle, int bits, VI& first, VI& last) {
  const int scale = 1 << bits;
  first = hn::ShiftRightSame(hn::Add(least, hn::Set(di, middle * scale + scale - 2)), bits);
  last = hn::ShiftRightSame(hn::Add(most, hn::Set(di, middle * scale + 1)), bits);
}

struct Corners {
  VI x[3], y[3];
};

Corners corners(const float* vertex, VU a, VU b, VU c) {
  Corners out;
  const auto* packed = reinterpret_cast<const std::int32_t*>(vertex) + 3;
  const VU index[3] = {a, b, c};
  for (int k = 0; k < 3; ++k) {
    const VI p = hn::GatherIndex(di, packed, hn::BitCast(di, hn::ShiftLeft<2>(index[k])));
    out.x[k] = hn::ShiftRight<16>(p);
    out.y[k] = hn::ShiftRight<16>(hn::ShiftLeft<16>(p));
  }
  return out;
}

/// True where the face is surely seen from behind: its area in the image, less what rounding may have added.
hn::Mask<DF> from_behind(const RasterCamera& camera, const Corners& c) {
  auto side = [&](VI to, VI from) { return hn::ConvertTo(df, hn::Sub(to, from)); };
  const VF x1 = side(c.x[1], c.x[0]), y1 = side(c.y[1], c.y[0]), x2 = side(c.x[2], c.x[0]), y2 = side(c.y[2], c.y[0]);
  const VF p = hn::Mul(x1, y2), q = hn::Mul(x2, y1);
  const VF area = hn::Mul(hn::Sub(p, q), hn::Set(df, camera.front));
  const VF sides = hn::Add(hn::Add(hn::Abs(x1), hn::Abs(y1)), hn::Add(hn::Abs(x2), hn::Abs(y2)));
  const VF rounding = hn::Mul(hn::Add(hn::Abs(p), hn::Abs(q)), hn::Set(df, 1e-6f));
  const VF slack = hn::Add(hn::Add(hn::Mul(sides, hn::Set(df, 1.1f)), hn::Set(df, 2.f)), rounding);
  return hn::Lt(area, hn::Neg(slack));
}

/// The face's pixels by its exact corners, for one that passes the camera's plane or goes far out of the image. False:
/// none. What it leaves out depends on the image, not on the rows that are drawn.
bool box_of_far_face(const RasterCamera& camera, const float* const* v, std::uint32_t& columns, std::uint32_t& rows) {
  constexpr float margin = 0.125f;  // px, more than rounding moves a corner
  const float left = static_cast<float>(-camera.middle_x) - margin, top = static_cast<float>(-camera.middle_y) - margin;
  const float right = static_cast<float>(camera.cols - 1 - camera.middle_x) + margin;
  const float bottom = static_cast<float>(camera.rows - 1 - camera.middle_y) + margin;
  int outside[5] = {}, before = 0;
  float x0 = right, x1 = left, y0 = bottom, y1 = top;
  for (int k = 0; k < 3; ++k) {
    const float x = v[k][0], y = v[k][1], w = v[k][2];
    outside[0] += x < left * w;
    outside[1] += x > right * w;
    outside[2] += y < top * w;
    outside[3] += y > bottom * w;
    outside[4] += w <= 0;
    if (w <= kLeastDepth) continue;
    ++before;
    x0 = std::min(x0, x / w - margin), x1 = std::max(x1, x / w + margin);
    y0 = std::min(y0, y / w - margin), y1 = std::max(y1, y / w + margin);
  }
  for (int side : outside)
    if (side == 3) return false;
  if (before < 3) x0 = left, x1 = right, y0 = top, y1 = bottom;
  const auto first = [](float least, float of) { return static_cast<int>(std::ceil(std::max(least, of))); };
  const auto last = [](float most, float of) { return static_cast<int>(std::floor(std::min(most, of))); };
  const int c0 = first(x0, left + margin) + camera.middle_x, c1 = last(x1, right - margin) + camera.middle_x;
  const int r0 = std::max(first(y0, top + margin) + camera.middle_y, camera.first_row);
  const int r1 = std::min(last(y1, bottom - margin) + camera.middle_y, camera.end_row - 1);
  columns = static_cast<std::uint32_t>(c0 | c1 << 16);
  rows = static_cast<std::uint32_t>(r0 | r1 << 16);
  return c0 <= c1 && r0 <= r1;
}

void add_far_faces(const RasterCamera& camera, const std::uint32_t* face, std::size_t first, std::uint64_t bits,
                   const float* vertex, RasterBoxes& boxes) {
  for (; bits != 0; bits &= bits - 1) {
    const auto f = static_cast<std::uint32_t>(first + hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
    const float* v[3];
    for (int k = 0; k < 3; ++k) v[k] = vertex + 4 * std::size_t{face[3 * f + static_cast<std::uint32_t>(k)]};
    std::uint32_t columns, rows;
    if (!box_of_far_face(camera, v, columns, rows)) continue;
    boxes.face.data()[boxes.size] = f;
    boxes.columns.data()[boxes.size] = columns;
    boxes.rows.data()[boxes.size] = rows;
    ++boxes.size;
  }
}

void load_faces(const std::uint32_t* face, std::size_t faces, std::size_t first, VU& a, VU& b, VU& c) {
  if (first + kLanes <= faces) return hn::LoadInterleaved3(du, face + 3 * first, a, b, c);
  std::uint32_t rest[3 * kLanes] = {};
  std::copy(face + 3 * first, face + 3 * faces, rest);
  hn::LoadInterleaved3(du, rest, a, b, c);
}

template <class M>
std::uint64_t bits_of(M mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(di, mask, bytes);
  std::uint64_t bits;
  std::memcpy(&bits, bytes, 8);
  return bits;
}

void select(const RasterCamera& camera, const std::uint32_t* face, std::size_t faces, std::size_t first,
            std::size_t end, const float* vertex, RasterBoxes& boxes) {
  const int bits = camera.fraction_bits;
  for (std::size_t f = first; f < end; f += kLanes) {
    VU a, b, c;
    load_faces(face, faces, f, a, b, c);
    const Corners at = corners(vertex, a, b, c);
    const VI least_x = hn::Min(at.x[0], hn::Min(at.x[1], at.x[2])),
             most_x = hn::Max(at.x[0], hn::Max(at.x[1], at.x[2]));
    const VI least_y = hn::Min(at.y[0], hn::Min(at.y[1], at.y[2])),
             most_y = hn::Max(at.y[0], hn::Max(at.y[1], at.y[2]));
    const auto given = hn::FirstN(di, end - f);
    const auto far = hn::And(given, hn::Eq(least_x, hn::Set(di, kUnknown)));
    VI x0, x1, y0, y1;
    pixels_of(least_x, most_x, camera.middle_x, bits, x0, x1);
    pixels_of(least_y, most_y, camera.middle_y, bits, y0, y1);
    x0 = hn::Max(x0, hn::Zero(di));
    x1 = hn::Min(x1, hn::Set(di, camera.cols - 1));
    y0 = hn::Max(y0, hn::Set(di, camera.first_row));
    y1 = hn::Min(y1, hn::Set(di, camera.end_row - 1));
    auto chosen = hn::And(hn::AndNot(far, given), hn::Not(hn::Or(hn::Gt(x0, x1), hn::Gt(y0, y1))));
    if (camera.cull) chosen = hn::AndNot(hn::RebindMask(di, from_behind(camera, at)), chosen);
    const VU number = hn::Add(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(f)));
    const auto columns = hn::BitCast(du, hn::Or(x0, hn::ShiftLeft<16>(x1)));
    const auto rows = hn::BitCast(du, hn::Or(y0, hn::ShiftLeft<16>(y1)));
    const auto chosen_u = hn::RebindMask(du, chosen);
    // Compressed in registers: storing compressed is slow on some processors.
    hn::StoreU(hn::Compress(number, chosen_u), du, boxes.face.data() + boxes.size);
    hn::StoreU(hn::Compress(columns, chosen_u), du, boxes.columns.data() + boxes.size);
    hn::StoreU(hn::Compress(rows, chosen_u), du, boxes.rows.data() + boxes.size);
    boxes.size += hn::CountTrue(du, chosen_u);
    if (!hn::AllFalse(di, far)) add_far_faces(camera, face, f, bits_of(far), vertex, boxes);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace ppm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ppm {
HWY_EXPORT(project);
HWY_EXPORT(select);

void raster_project(const RasterCamera& camera, const float* position, std::size_t count, float* vertex) {
  HWY_DYNAMIC_DISPATCH(project)(camera, position, count, vertex);
}

void raster_select(const RasterCamera& camera, const std::uint32_t* face, std::size_t faces, std::size_t first,
                   std::size_t end, const float* vertex, RasterBoxes& boxes) {
  HWY_DYNAMIC_DISPATCH(select)(camera, face, faces, first, end, vertex, boxes);
}
}  // namespace ppm
#endif
