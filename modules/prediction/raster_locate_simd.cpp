// Where on its face a pixel's ray arrives, and which texels lie around.
#include "modules/prediction/raster_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/prediction/raster_locate_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ppm {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using DF = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<DF>;
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;
constexpr DF df;
constexpr DI di;
constexpr std::size_t kLanes = hn::MaxLanes(df);

struct Line {
  VF a, b, c, last;  // a x + b y + c, and what stands beside
};

Line load(const float* quad, std::size_t i) {
  Line line;
  hn::LoadInterleaved4(df, quad + 4 * i, line.a, line.b, line.c, line.last);
  return line;
}
VF at(const Line& line, VF x, VF y) {
  return hn::Add(hn::Mul(line.a, x), hn::Add(hn::Mul(line.b, y), line.c));
}

/// texel_index() of texel_grid.hpp.
VI texel_index(VI n, VI i, VI j) {
  const VI one = hn::Set(di, 1);
  return hn::Add(hn::Sub(hn::Mul(i, hn::Add(n, one)), hn::ShiftRight<1>(hn::Mul(i, hn::Sub(i, one)))), j);
}

/// texel_triangle() of texel_grid.hpp, and with linear false nearest_texel() as all the weight.
void texels_around(VI n, VF u, VF v, bool linear, RasterPixels& pixels, std::size_t p) {
  const VF zero = hn::Zero(df), one = hn::Set(df, 1.f), steps = hn::ConvertTo(df, n);
  const VI one_i = hn::Set(di, 1);
  const VF x = hn::Mul(hn::Min(hn::Max(u, zero), one), steps), y = hn::Mul(hn::Min(hn::Max(v, zero), one), steps);
  const VI i = hn::Min(hn::ConvertTo(di, x), hn::Sub(n, one_i));
  const VI j = hn::Min(hn::ConvertTo(di, y), hn::Sub(hn::Sub(n, one_i), i));
  const VF a = hn::Min(hn::Sub(x, hn::ConvertTo(df, i)), one), b = hn::Min(hn::Sub(y, hn::ConvertTo(df, j)), one);
  const auto upper = hn::And(hn::Gt(hn::Add(a, b), one), hn::RebindMask(df, hn::Lt(hn::Add(i, j), hn::Sub(n, one_i))));
  const VI up = hn::IfThenElseZero(hn::RebindMask(di, upper), one_i);
  VF w1 = hn::IfThenElse(upper, hn::Sub(one, b), a), w2 = hn::IfThenElse(upper, hn::Sub(one, a), b);
  VF w0 = hn::Max(hn::Sub(hn::Sub(one, w1), w2), zero);
  if (!linear) {
    const auto second = hn::Gt(w1, w0);
    const auto third = hn::Gt(w2, hn::Max(w0, w1));
    w0 = hn::IfThenElse(hn::Or(second, third), zero, one);
    w1 = hn::IfThenElse(hn::AndNot(third, second), one, zero);
    w2 = hn::IfThenElse(third, one, zero);
  }
  hn::Store(texel_index(n, hn::Add(i, up), hn::Add(j, up)), di, pixels.texel[0].value + p);
  hn::Store(texel_index(n, hn::Add(i, one_i), j), di, pixels.texel[1].value + p);
  hn::Store(texel_index(n, i, hn::Add(j, one_i)), di, pixels.texel[2].value + p);
  hn::Store(w0, df, pixels.weight[0].value + p);
  hn::Store(w1, df, pixels.weight[1].value + p);
  hn::Store(w2, df, pixels.weight[2].value + p);
}

/// Length of the ray with unit depth.
VF ray_length(const RasterCamera& camera, VF x, VF y) {
  const VF rx = hn::Add(hn::Mul(hn::Set(df, camera.ray_x), x), hn::Set(df, camera.ray_x0));
  const VF ry = hn::Add(hn::Mul(hn::Set(df, camera.ray_y), y), hn::Set(df, camera.ray_y0));
  return hn::Sqrt(hn::Add(hn::Add(hn::Mul(rx, rx), hn::Mul(ry, ry)), hn::Set(df, 1.f)));
}

void locate(const RasterCamera& camera, bool linear, RasterPixels& pixels) {
  for (std::size_t p = 0; p < pixels.size; p += kLanes) {
    const VF x = hn::Load(df, pixels.x.value + p), y = hn::Load(df, pixels.y.value + p);
    const Line edge1 = load(pixels.quad[0], p), edge2 = load(pixels.quad[1], p), plane = load(pixels.quad[2], p);
    const VF depth = hn::Div(hn::Set(df, 1.f), at(plane, x, y));
    const VF range = hn::Mul(depth, ray_length(camera, x, y));
    const VF per_edge = hn::Mul(edge1.last, depth);
    const VF u = hn::Mul(at(edge1, x, y), per_edge), v = hn::Mul(at(edge2, x, y), per_edge);
    hn::Store(range, df, pixels.range.value + p);
    hn::Store(hn::Div(hn::Abs(edge2.last), range), df, pixels.cosine.value + p);
    hn::Store(u, df, pixels.u.value + p);
    hn::Store(v, df, pixels.v.value + p);
    texels_around(hn::Load(di, pixels.divisions.value + p), u, v, linear, pixels, p);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace ppm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ppm {
HWY_EXPORT(locate);

void raster_locate(const RasterCamera& camera, bool linear, RasterPixels& pixels) {
  HWY_DYNAMIC_DISPATCH(locate)(camera, linear, pixels);
}
}  // namespace ppm
#endif
