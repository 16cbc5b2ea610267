#include <limits>

#include "modules/prediction/warp_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/prediction/warp_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ppm::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using FloatV = hn::Vec<Floats>;
using IntV = hn::Vec<Ints>;

HWY_INLINE FloatV set(float value) {
  return hn::Set(Floats(), value);
}

// a x + b y + c
HWY_INLINE FloatV affine(float a, FloatV x, float b, FloatV y, float c) {
  return hn::Add(hn::Add(hn::Mul(set(a), x), hn::Mul(set(b), y)), set(c));
}

HWY_INLINE FloatV dot(FloatV ax, FloatV bx, FloatV ay, FloatV by, FloatV az, FloatV bz) {
  return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}

// 1 / x for x near 1, by Newton's method: to 3e-6 within a fifth of 1. Divisions and roots would be most of the time of
// what is computed here.
HWY_INLINE FloatV inverse_near_one(FloatV x) {
  const auto two = set(2.0f);
  auto y = hn::Sub(two, x);
  for (int i = 0; i < 2; ++i) y = hn::Mul(y, hn::Sub(two, hn::Mul(x, y)));
  return y;
}

// 1 / sqrt(x) of a normal x, to float's accuracy: Newton's method from a linear guess on the bits.
HWY_INLINE FloatV inverse_root(FloatV x) {
  const Ints di;
  auto y = hn::BitCast(Floats(), hn::Sub(hn::Set(di, 0x5f375a86), hn::ShiftRight<1>(hn::BitCast(di, x))));
  const auto half = hn::Mul(x, set(0.5f));
  for (int i = 0; i < 3; ++i) y = hn::Mul(y, hn::Sub(set(1.5f), hn::Mul(hn::Mul(half, y), y)));
  return y;
}

// Into [0, most]; of NaN some number in it, or NaN, which is converted to 0.
HWY_INLINE FloatV clamp(FloatV v, float most) {
  return hn::Min(hn::Max(v, hn::Zero(Floats())), set(most));
}

// Column and row of pixels. Exact below 2^24 pixels.
HWY_INLINE void place(IntV pixel, int cols, FloatV& x, FloatV& y) {
  const auto width = set(static_cast<float>(cols)), one = set(1.0f);
  const auto p = hn::ConvertTo(Floats(), pixel);
  y = hn::Floor(hn::Mul(hn::Add(p, set(0.5f)), set(1.0f / static_cast<float>(cols))));
  x = hn::Sub(p, hn::Mul(y, width));
  const auto under = hn::Lt(x, hn::Zero(Floats())), over = hn::Ge(x, width);
  y = hn::Add(hn::Sub(y, hn::IfThenElseZero(under, one)), hn::IfThenElseZero(over, one));
  x = hn::Sub(hn::Add(x, hn::IfThenElseZero(under, width)), hn::IfThenElseZero(over, width));
}

// Some rays of the predicted camera, as points that move over the planes' view with their inverse depth.
struct Rays {
  const PlaneArrays& planes;
  const Warp& warp;
  FloatV turned_x, turned_y, turned_z;
  FloatV x, y;  // the pixel of the planes' view that is looked at, whole numbers
  IntV index;

  // Looks at the pixel where the points of that inverse depth are seen; beyond the border, at the border.
  HWY_INLINE void look(FloatV disparity) {
    const auto px = hn::Add(turned_x, hn::Mul(disparity, set(warp.shift[0])));
    const auto py = hn::Add(turned_y, hn::Mul(disparity, set(warp.shift[1])));
    const auto pz = hn::Add(turned_z, hn::Mul(disparity, set(warp.shift[2])));
    const auto scale = inverse_near_one(pz);
    x = hn::Round(clamp(hn::Mul(px, scale), static_cast<float>(planes.cols - 1)));
    y = hn::Round(clamp(hn::Mul(py, scale), static_cast<float>(planes.rows - 1)));
    index = hn::ConvertTo(Ints(), hn::Add(hn::Mul(y, set(static_cast<float>(planes.cols))), x));
  }
  HWY_INLINE FloatV read(const float* array) const { return hn::GatherIndex(Floats(), array, index); }
};

HWY_INLINE void sample(const PlaneArrays& planes, const Warp& warp, IntV pixel, float least_cosine, float* range,
                       float* variance, float* cosine, std::uint32_t* found) {
  const Floats d;
  const auto zero = hn::Zero(d), one = set(1.0f);
  FloatV px, py;
  place(pixel, warp.cols, px, py);
  const float* t = warp.turn;
  Rays rays{planes,
            warp,
            affine(t[0], px, t[1], py, t[2]),
            affine(t[3], px, t[4], py, t[5]),
            affine(t[6], px, t[7], py, t[8]),
            zero,
            zero,
            hn::Zero(Ints())};
  // By direction alone, then by the depth found there: a second step makes nothing better.
  rays.look(zero);
  rays.look(rays.read(planes.disparity));

  // 1/z of the plane is linear in homogeneous coordinates of pixels: q . (x, y, 1)
  const auto own = rays.read(planes.disparity), qx = rays.read(planes.per_x), qy = rays.read(planes.per_y);
  const auto qz = hn::Sub(hn::Sub(own, hn::Mul(qx, rays.x)), hn::Mul(qy, rays.y));
  const auto along = dot(qx, rays.turned_x, qy, rays.turned_y, qz, rays.turned_z);
  const auto ahead =
      hn::Sub(one, dot(qx, set(warp.shift[0]), qy, set(warp.shift[1]), qz, set(warp.shift[2])));
  // The plane is met at inverse depth along / ahead. Where that is far from what the pixel shows, the plane is seen too
  // flat to be carried on: the pixel's own depth stands.
  const auto met = hn::And(hn::Gt(along, hn::Mul(set(0.5f), hn::Mul(own, ahead))),
                           hn::Lt(along, hn::Mul(set(2.0f), hn::Mul(own, ahead))));
  const auto rx = hn::Mul(hn::Sub(px, set(warp.cx)), set(1 / warp.fx));
  const auto ry = hn::Mul(hn::Sub(py, set(warp.cy)), set(1 / warp.fy));
  const auto length2 = dot(rx, rx, ry, ry, one, one), per_length = inverse_root(length2);
  const auto distance = rays.read(planes.distance);
  const auto facing = hn::Mul(hn::Mul(hn::Abs(along), distance), per_length);
  const auto c = hn::IfThenElse(hn::Lt(facing, set(least_cosine)), set(least_cosine), facing);
  // Range = length * above / below, and 1 / c, by one division.
  const auto above = hn::IfThenElse(met, ahead, one), below = hn::IfThenElse(met, along, own);
  const auto quotient = hn::Div(one, hn::Mul(below, c));
  const auto per_c = hn::Mul(quotient, below);
  const auto expected = hn::Mul(hn::Mul(hn::Mul(length2, per_length), above), hn::Mul(quotient, c));

  const auto hit = hn::Gt(distance, zero);
  hn::StoreU(hn::IfThenElse(hit, expected, set(std::numeric_limits<float>::infinity())), d, range);
  hn::StoreU(hn::IfThenElseZero(hit, hn::Mul(rays.read(planes.variance), hn::Mul(per_c, per_c))), d, variance);
  hn::StoreU(hn::IfThenElse(hit, c, one), d, cosine);
  hn::StoreU(hn::BitCast(hn::RebindToUnsigned<Floats>(), rays.index), hn::RebindToUnsigned<Floats>(), found);
}

void samples(const PlaneArrays& planes, const Warp& warp, const std::uint32_t* pixels, std::size_t n,
             float least_cosine, float* range, float* variance, float* cosine, std::uint32_t* found) {
  const hn::RebindToUnsigned<Floats> du;
  const std::size_t lanes = hn::Lanes(Floats());
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes)
    sample(planes, warp, hn::BitCast(Ints(), hn::LoadU(du, pixels + i)), least_cosine, range + i, variance + i,
           cosine + i, found + i);
  if (i == n) return;
  constexpr std::size_t kMost = HWY_MAX_BYTES / sizeof(float);
  std::uint32_t last[kMost] = {}, last_found[kMost];
  float last_range[kMost], last_variance[kMost], last_cosine[kMost];
  for (std::size_t k = i; k < n; ++k) last[k - i] = pixels[k];
  sample(planes, warp, hn::BitCast(Ints(), hn::LoadU(du, last)), least_cosine, last_range, last_variance, last_cosine,
         last_found);
  for (std::size_t k = i; k < n; ++k) {
    range[k] = last_range[k - i];
    variance[k] = last_variance[k - i];
    cosine[k] = last_cosine[k - i];
    found[k] = last_found[k - i];
  }
}

}  // namespace ppm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ppm {

HWY_EXPORT(samples);

void warp_samples(const PlaneArrays& planes, const Warp& warp, const std::uint32_t* pixels, std::size_t n,
                  float least_cosine, float* range, float* variance, float* cosine, std::uint32_t* found) {
  HWY_DYNAMIC_DISPATCH(samples)(planes, warp, pixels, n, least_cosine, range, variance, cosine, found);
}

}  // namespace ppm
#endif
