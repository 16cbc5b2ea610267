#include "modules/maps/vdb/leaf_look.hpp"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/maps/vdb/leaf_look_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ppm {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using S = hn::Rebind<std::int16_t, F>;

/// Where voxels lie along one axis of the camera.
template <class V>
V along(const LeafLook& look, int axis, V x, V y, V z) {
  const F d;
  const auto step = [&](int map_axis, V n) { return hn::Mul(hn::Set(d, look.step[map_axis][axis]), n); };
  return hn::Add(hn::Add(hn::Add(hn::Set(d, look.origin[axis]), step(0, x)), step(1, y)), step(2, z));
}

/// Voxels after evidence.
template <class VI, class V>
VI added(const LeafSum& sum, VI before, V evidence) {
  const F d;
  const auto unknown = hn::Eq(before, hn::Set(I(), std::numeric_limits<std::int16_t>::min()));
  const auto was = hn::ConvertTo(d, hn::IfThenZeroElse(unknown, before));
  const auto all = hn::Add(hn::Mul(hn::Set(d, sum.keep), was), evidence);
  return hn::NearestInt(hn::Min(hn::Max(all, hn::Set(d, sum.least)), hn::Set(d, sum.most)));
}

void add_everywhere(const LeafSum& sum, float evidence, std::int16_t* codes) {
  const F d;
  const S ds;
  for (std::size_t i = 0; i < 512; i += hn::Lanes(d)) {
    const auto before = hn::PromoteTo(I(), hn::LoadU(ds, codes + i));
    hn::StoreU(hn::DemoteTo(ds, added(sum, before, hn::Set(d, evidence))), ds, codes + i);
  }
}

void look_at(const LeafLook& look, const LeafSum& sum, std::int16_t* codes) {
  const F d;
  const I di;
  const S ds;
  const auto zero = hn::Zero(d);
  const auto seven = hn::Set(di, 7);
  for (int i = 0; i < 512; i += static_cast<int>(hn::Lanes(d))) {
    const auto n = hn::Iota(di, i);
    const auto x = hn::ConvertTo(d, hn::ShiftRight<6>(n));
    const auto y = hn::ConvertTo(d, hn::And(hn::ShiftRight<3>(n), seven));
    const auto z = hn::ConvertTo(d, hn::And(n, seven));
    const auto depth = along(look, 2, x, y, z);
    const auto inverse = hn::Div(hn::Set(d, 1.0f), depth);
    const auto u = hn::Add(hn::Mul(hn::Mul(hn::Set(d, look.fx), along(look, 0, x, y, z)), inverse), hn::Set(d, look.cx));
    const auto v = hn::Add(hn::Mul(hn::Mul(hn::Set(d, look.fy), along(look, 1, x, y, z)), inverse), hn::Set(d, look.cy));
    const auto in_cols = hn::And(hn::Ge(u, zero), hn::Lt(u, hn::Set(d, static_cast<float>(look.cols))));
    const auto in_rows = hn::And(hn::Ge(v, zero), hn::Lt(v, hn::Set(d, static_cast<float>(look.rows))));
    const auto inside = hn::And(hn::And(in_cols, in_rows), hn::Gt(depth, zero));
    if (hn::AllFalse(d, inside)) continue;
    const auto row = hn::ConvertTo(di, hn::IfThenElseZero(inside, v));
    const auto column = hn::ConvertTo(di, hn::IfThenElseZero(inside, u));
    const auto at = hn::ShiftLeft<2>(hn::Add(hn::Mul(row, hn::Set(di, look.cols)), column));
    const auto told = hn::And(inside, hn::Le(depth, hn::GatherIndex(d, look.pixel + 2, at)));
    if (hn::AllFalse(d, told)) continue;
    const auto behind = hn::Sub(depth, hn::GatherIndex(d, look.pixel, at));
    const auto ramp = hn::Mul(hn::GatherIndex(d, look.pixel + 1, at), behind);
    const auto evidence = hn::Min(hn::Max(ramp, hn::Set(d, look.miss)), hn::Set(d, look.hit));
    const auto before = hn::PromoteTo(di, hn::LoadU(ds, codes + i));
    const auto after = hn::IfThenElse(hn::RebindMask(di, told), added(sum, before, evidence), before);
    hn::StoreU(hn::DemoteTo(ds, after), ds, codes + i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace ppm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ppm {

HWY_EXPORT(add_everywhere);
HWY_EXPORT(look_at);

void add_to_leaf(const LeafSum& sum, float evidence, std::int16_t* codes) {
  HWY_DYNAMIC_DISPATCH(add_everywhere)(sum, evidence, codes);
}

void look_at_leaf(const LeafLook& look, const LeafSum& sum, std::int16_t* codes) {
  HWY_DYNAMIC_DISPATCH(look_at)(look, sum, codes);
}

}  // namespace ppm
#endif
