#include "apps/bench/roofs.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "apps/bench/roofs_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ppm::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

FlopsDone MultiplyAdds(std::size_t rounds) {
  const hn::ScalableTag<float> d;
  const auto scale = hn::Set(d, 0.999f), step = hn::Set(d, 0.25f);
  // Ten chains: more than the latency of a multiply-add times the units that do them.
  auto a = hn::Iota(d, 0), b = hn::Iota(d, 1), c = hn::Iota(d, 2), e = hn::Iota(d, 3), f = hn::Iota(d, 4);
  auto g = hn::Iota(d, 5), h = hn::Iota(d, 6), i = hn::Iota(d, 7), j = hn::Iota(d, 8), k = hn::Iota(d, 9);
  for (std::size_t round = 0; round < rounds; ++round) {
    a = hn::MulAdd(a, scale, step), b = hn::MulAdd(b, scale, step), c = hn::MulAdd(c, scale, step);
    e = hn::MulAdd(e, scale, step), f = hn::MulAdd(f, scale, step), g = hn::MulAdd(g, scale, step);
    h = hn::MulAdd(h, scale, step), i = hn::MulAdd(i, scale, step), j = hn::MulAdd(j, scale, step);
    k = hn::MulAdd(k, scale, step);
  }
  const auto sum =
      hn::Add(hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, e)), hn::Add(hn::Add(f, g), hn::Add(h, i))), hn::Add(j, k));
  return {2.0 * 10 * static_cast<double>(hn::Lanes(d)) * static_cast<double>(rounds),
          hn::GetLane(hn::SumOfLanes(d, sum))};
}

float ReadSum(const float* data, std::size_t n) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  auto a = hn::Zero(d), b = a, c = a, e = a;
  for (std::size_t i = 0; i < n; i += 4 * lanes) {
    a = hn::Add(a, hn::Load(d, data + i));
    b = hn::Add(b, hn::Load(d, data + i + lanes));
    c = hn::Add(c, hn::Load(d, data + i + 2 * lanes));
    e = hn::Add(e, hn::Load(d, data + i + 3 * lanes));
  }
  return hn::GetLane(hn::SumOfLanes(d, hn::Add(hn::Add(a, b), hn::Add(c, e))));
}

const char* Target() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace ppm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ppm {

HWY_EXPORT(MultiplyAdds);
HWY_EXPORT(ReadSum);
HWY_EXPORT(Target);

FlopsDone multiply_adds(std::size_t rounds) {
  return HWY_DYNAMIC_DISPATCH(MultiplyAdds)(rounds);
}
float read_sum(const float* data, std::size_t n) {
  return HWY_DYNAMIC_DISPATCH(ReadSum)(data, n);
}
const char* roof_target() {
  return HWY_DYNAMIC_DISPATCH(Target)();
}

}  // namespace ppm
#endif
