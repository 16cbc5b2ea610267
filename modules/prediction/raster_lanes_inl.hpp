// The vectors of the rasterizer's kernels, 16 floats at most: for files that are compiled once for each target.
#include <cstddef>
#include <hwy/highway.h>

#if defined(PPM_RASTER_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef PPM_RASTER_LANES_INL
#undef PPM_RASTER_LANES_INL
#else
#define PPM_RASTER_LANES_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace ppm::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using DF = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<DF>;
using DU = hn::RebindToUnsigned<DF>;
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;
using VU = hn::Vec<DU>;
using MF = hn::Mask<DF>;
constexpr DF df;
constexpr DI di;
constexpr DU du;
constexpr std::size_t kLanes = hn::MaxLanes(df);

}  // namespace ppm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
