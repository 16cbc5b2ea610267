#include "modules/maps/ppm/element_rows.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/maps/ppm/element_rows_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ppm {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::uint32_t kNone = 0xffffffffu;

std::size_t find_starts(const ElementRow& row, std::uint32_t* starts) {
  const hn::ScalableTag<std::uint32_t> d;
  const std::size_t lanes = hn::Lanes(d);
  if (row.pixels == 0) return 0;
  starts[0] = 0;
  std::size_t count = 1, p = 1;
  for (; p + lanes <= row.pixels; p += lanes) {
    const auto other_chunk = hn::Ne(hn::LoadU(d, row.chunk + p), hn::LoadU(d, row.chunk + p - 1));
    const auto other_face = hn::Ne(hn::LoadU(d, row.face + p), hn::LoadU(d, row.face + p - 1));
    const auto other = hn::Or(other_chunk, other_face);
    if (hn::AllFalse(d, other)) continue;
    count += hn::CompressStore(hn::Iota(d, static_cast<std::uint32_t>(p)), other, d, starts + count);
  }
  for (; p < row.pixels; ++p)
    if (row.chunk[p] != row.chunk[p - 1] || row.face[p] != row.face[p - 1])
      starts[count++] = static_cast<std::uint32_t>(p);
  return count;
}

RowCounts read(const ElementRow& row, std::uint32_t* starts) {
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::RebindToUnsigned<decltype(d)> du;
  const std::size_t lanes = hn::Lanes(d);
  RowCounts counts{find_starts(row, starts)};
  const auto from_pixel = hn::Mul(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(row.depth_step)));
  std::size_t p = 0;
  for (; p + lanes <= row.pixels; p += lanes) {
    const float* const first = row.depth + p * row.depth_step;
    const auto z = row.depth_step == 1 ? hn::LoadU(d, first) : hn::GatherIndex(d, first, from_pixel);
    const auto measured = hn::Eq(z, z);
    const auto missed = hn::RebindMask(d, hn::Eq(hn::LoadU(du, row.chunk + p), hn::Set(du, kNone)));
    counts.measured += hn::CountTrue(d, measured);
    counts.missed += hn::CountTrue(d, hn::And(measured, missed));
  }
  for (; p < row.pixels; ++p) {
    const float z = row.depth[p * row.depth_step];
    counts.measured += z == z;
    counts.missed += z == z && row.chunk[p] == kNone;
  }
  return counts;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace ppm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ppm {

HWY_EXPORT(read);

RowCounts read_row(const ElementRow& row, std::uint32_t* starts) {
  return HWY_DYNAMIC_DISPATCH(read)(row, starts);
}

}  // namespace ppm
#endif
