#include "modules/maps/ppm/texel_gather.hpp"

#include "modules/maps/ppm/grid_steps.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/maps/ppm/texel_gather_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "modules/maps/ppm/face_in_view_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ppm {
namespace HWY_NAMESPACE {
namespace {

/// The first `count` of some values, the others are not touched; they come as 0.
template <class D>
HWY_INLINE hn::Vec<D> load_some(D d, const float* values, std::size_t count) {
#if HWY_TARGET <= HWY_AVX2
  return hn::MaskedLoad(hn::FirstN(d, count), d, values);
#else
  HWY_ALIGN float some[hn::MaxLanes(d)] = {};
  for (std::size_t k = 0; k < count && k < hn::Lanes(d); ++k) some[k] = values[k];
  return hn::Load(d, some);
#endif
}

/// Stores the lanes that are set in the mask and touches no others.
template <class D>
HWY_INLINE void store_some(D d, hn::Mask<D> set, hn::Vec<D> from, float* values) {
#if HWY_TARGET <= HWY_AVX2
  hn::BlendedStore(from, set, d, values);
#else
  HWY_ALIGN float some[hn::MaxLanes(d)];
  hn::Store(from, d, some);
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, set, bits);
  for (std::size_t k = 0; k < hn::Lanes(d); ++k)
    if (bits[k / 8] >> (k % 8) & 1) values[k] = some[k];
#endif
}

/// The four measured pixels around each texel's image, one texel a lane.
template <class D>
struct Window {
  hn::Vec<D> left, top;               // column and row of the first
  hn::Vec<D> right_part, lower_part;  // 0 .. 1, how far the image lies towards the others
  hn::Vec<D> z00, z10, z01, z11;      // m, depths: first row, second row; NaN = no return
  hn::Vec<D> nearest, sigma;          // m, of the nearest of them
};

/// What the texels of a face read and compute, one a lane.
template <class D>
class Nodes {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  using DI = hn::RebindToSigned<D>;

  HWY_INLINE Nodes(const GatherImage& image, const GatherGate& gate, const FaceInView& face)
      : image_(image), gate_(gate), face_(face) {}

  /// Updates texels at (i, j), of which the first `count` are there.
  HWY_INLINE void update(V i, V j, std::size_t count, float* means, float* variances) {
    const Vec3<D> p{along(0, i, j), along(1, i, j), along(2, i, j)};
    const V w = hn::Div(set(1), p.z);
    V x = hn::Add(hn::Mul(hn::Mul(set(image_.fx), p.x), w), set(image_.cx));
    V y = hn::Add(hn::Mul(hn::Mul(set(image_.fy), p.y), w), set(image_.cy));
    M seen = hn::And(hn::And(hn::FirstN(D(), count), hn::Gt(p.z, set(0))),
                     hn::And(within(x, image_.cols), within(y, image_.rows)));
    if (hn::AllFalse(D(), seen)) return;
    const Window<D> window = read(hn::IfThenElseZero(seen, x), hn::IfThenElseZero(seen, y));
    seen = hn::And(seen, hn::Eq(window.nearest, window.nearest));
    if (hn::AllFalse(D(), seen)) return;

    const V mean = load_some(D(), means, count), variance = load_some(D(), variances, count);
    const V range2 = dot(p.x, p.y, p.z, p.x, p.y, p.z);
    const V cosine2 =
        hn::Max(hn::Div(set(face_.offset * face_.offset), range2), set(gate_.least_cosine * gate_.least_cosine));
    const V sensor = hn::Mul(hn::Mul(window.sigma, window.sigma), cosine2);
    const V map = hn::Min(hn::Add(variance, set(face_.excess)), set(gate_.map_variance_most));
    V sum, total;  // of weighted distances from the mean; of the weights
    compare(window, mean,
            hn::Mul(set(gate_.sigmas * gate_.sigmas), hn::Add(hn::Add(sensor, set(gate_.pose_variance)), map)), sum,
            total);
    seen = hn::And(seen, hn::Ge(total, set(0.5f)));
    if (hn::AllFalse(D(), seen)) return;

    const V noise = measured_variance(sensor, p.z, range2, cosine2);
    // The conjugate Gaussian, see fuse(), with one division for both mean and variance.
    const V gain = hn::Div(variance, hn::Mul(total, hn::Add(variance, noise)));
    store_some(D(), seen, hn::Add(mean, hn::Mul(gain, sum)), means);
    store_some(D(), seen, hn::Mul(hn::Mul(gain, total), noise), variances);
  }

 private:
  static HWY_INLINE V set(float value) { return hn::Set(D(), value); }
  static HWY_INLINE M within(V at, int pixels) {
    return hn::And(hn::Ge(at, set(0)), hn::Le(at, set(static_cast<float>(pixels - 1))));
  }
  /// A coordinate of the texels, m.
  HWY_INLINE V along(std::size_t axis, V i, V j) const {
    return hn::Add(set(face_.corner[axis]),
                   hn::Add(hn::Mul(i, set(face_.step_i[axis])), hn::Mul(j, set(face_.step_j[axis]))));
  }

  /// x, y: inside the image.
  HWY_INLINE Window<D> read(V x, V y) const {
    const D d;
    const DI di;
    const auto x0 = hn::Min(hn::ConvertTo(di, x), hn::Set(di, image_.cols - 2));
    const auto y0 = hn::Min(hn::ConvertTo(di, y), hn::Set(di, image_.rows - 2));
    const auto right = hn::Set(di, image_.col_step), down = hn::Set(di, image_.row_step);
    const auto at = hn::Add(hn::Mul(y0, down), hn::Mul(x0, right));
    Window<D> window;
    window.left = hn::ConvertTo(d, x0);
    window.top = hn::ConvertTo(d, y0);
    window.right_part = hn::Sub(x, window.left);
    window.lower_part = hn::Sub(y, window.top);
    window.z00 = hn::GatherIndex(d, image_.depth, at);
    window.z10 = hn::GatherIndex(d, image_.depth + image_.col_step, at);
    window.z01 = hn::GatherIndex(d, image_.depth + image_.row_step, at);
    window.z11 = hn::GatherIndex(d, image_.depth + image_.row_step + image_.col_step, at);
    const M is_right = hn::Ge(window.right_part, set(0.5f)), is_below = hn::Ge(window.lower_part, set(0.5f));
    window.nearest = hn::IfThenElse(is_below, hn::IfThenElse(is_right, window.z11, window.z01),
                                    hn::IfThenElse(is_right, window.z10, window.z00));
    const auto to_nearest = hn::Add(hn::IfThenElseZero(hn::RebindMask(di, is_right), right),
                                    hn::IfThenElseZero(hn::RebindMask(di, is_below), down));
    window.sigma = hn::GatherIndex(d, image_.sigma, hn::Add(at, to_nearest));
    return window;
  }

  /// How far the measured points lie from the texels' means, of those within the gate; limit2: m^2, its square.
  HWY_INLINE void compare(const Window<D>& window, V mean, V limit2, V& sum, V& total) const {
    sum = total = set(0);
    const auto take = [&](V z, V slope, V weight) HWY_ATTR {
      const V off = hn::Sub(hn::Sub(hn::Mul(z, slope), set(face_.offset)), mean);
      const M fits = hn::Le(hn::Mul(off, off), limit2);  // not where nothing was measured
      sum = hn::Add(sum, hn::IfThenElseZero(fits, hn::Mul(weight, off)));
      total = hn::Add(total, hn::IfThenElseZero(fits, weight));
    };
    const V slope_x = set(face_.slope_x), slope_y = set(face_.slope_y);
    const V slope = hn::Add(hn::Add(hn::Mul(window.left, slope_x), hn::Mul(window.top, slope_y)), set(face_.slope));
    const V slope_right = hn::Add(slope, slope_x);
    const V left_part = hn::Sub(set(1), window.right_part), upper_part = hn::Sub(set(1), window.lower_part);
    take(window.z00, slope, hn::Mul(left_part, upper_part));
    take(window.z10, slope_right, hn::Mul(window.right_part, upper_part));
    take(window.z01, hn::Add(slope, slope_y), hn::Mul(left_part, window.lower_part));
    take(window.z11, hn::Add(slope_right, slope_y), hn::Mul(window.right_part, window.lower_part));
  }

  /// Variance of a measurement along the normal, more where texels share a pixel, m^2. sensor: what the depth's noise
  /// adds.
  HWY_INLINE V measured_variance(V sensor, V depth, V range2, V cosine2) const {
    const V pixel = hn::Mul(depth, set(image_.inv_fx)), across = hn::Mul(set(image_.lateral_px), pixel);
    const V inverse_cosine = hn::Min(hn::Mul(hn::Sqrt(range2), set(face_.inverse_offset)), set(1 / gate_.least_cosine));
    const V texels = hn::Mul(hn::Mul(hn::Mul(pixel, pixel), set(face_.inverse_area)), inverse_cosine);
    return hn::Mul(hn::Add(sensor, hn::Mul(hn::Mul(across, across), hn::Sub(set(1), cosine2))),
                   hn::Max(set(1), texels));
  }

  const GatherImage& image_;
  const GatherGate& gate_;
  const FaceInView& face_;
};

/// All texels of a face with few divisions.
template <class D>
HWY_INLINE void update_small(D d, const GatherImage& image, const GatherGate& gate, const FaceInView& face,
                             std::uint32_t divisions, float* mean, float* variance) {
  const float* const i = &kGridSteps.i[texels_of_fewer(divisions)];
  const float* const j = &kGridSteps.j[texels_of_fewer(divisions)];
  const std::size_t count = texel_count(divisions), lanes = hn::Lanes(d);
  Nodes<D> nodes(image, gate, face);
  for (std::size_t t = 0; t < count; t += lanes)
    nodes.update(hn::LoadU(d, i + t), hn::LoadU(d, j + t), count - t, mean + t, variance + t);
}

/// ... and with many: row by row.
template <class D>
HWY_INLINE void update_large(D d, const GatherImage& image, const GatherGate& gate, const FaceInView& face,
                             std::uint32_t divisions, float* mean, float* variance) {
  const std::size_t lanes = hn::Lanes(d);
  Nodes<D> nodes(image, gate, face);
  for (std::size_t i = 0; i <= divisions; ++i) {
    const std::size_t count = divisions + 1 - i;
    for (std::size_t j = 0; j < count; j += lanes)
      nodes.update(hn::Set(d, static_cast<float>(i)), hn::Iota(d, static_cast<float>(j)), count - j, mean + j,
                   variance + j);
    mean += count;
    variance += count;
  }
}

HWY_INLINE void update_face(const GatherImage& image, const GatherGate& gate, const FaceInView& face,
                            std::uint32_t divisions, float* mean, float* variance) {
  const hn::ScalableTag<float> whole;
  const hn::CappedTag<float, 8> eight;
  const hn::CappedTag<float, 4> four;
  if (divisions > kTabledDivisions) return update_large(whole, image, gate, face, divisions, mean, variance);
  if (divisions == 1) return update_small(four, image, gate, face, divisions, mean, variance);
  if (divisions == 2) return update_small(eight, image, gate, face, divisions, mean, variance);
  update_small(whole, image, gate, face, divisions, mean, variance);
}

void gather(const GatherImage& image, const GatherGate& gate, const GatherFaces& of, const std::uint32_t* faces,
            std::size_t count) {
  using D = hn::ScalableTag<float>;
  const D d;
  const hn::RebindToSigned<D> di;
  constexpr std::size_t kMost = hn::MaxLanes(D());
  FaceSetup<D> setup(image, of);
  FaceInView in_view[kMost];
  for (std::size_t start = 0; start < count; start += hn::Lanes(d)) {
    const std::size_t some = HWY_MIN(hn::Lanes(d), count - start);
    HWY_ALIGN std::int32_t number[kMost];
    HWY_ALIGN float divisions[kMost];
    for (std::size_t k = 0; k < hn::Lanes(d); ++k) {  // lanes beyond the last repeat it
      const auto f = faces[start + HWY_MIN(k, some - 1)];
      number[k] = static_cast<std::int32_t>(f);
      divisions[k] = of.divisions[f];
    }
    setup.run(d, hn::Load(di, number), hn::Load(d, divisions), in_view);
    for (std::size_t k = 0; k < some; ++k) {
      const auto f = faces[start + k];
      if (!(in_view[k].offset < 0)) continue;  // seen from behind
      in_view[k].excess = HWY_MAX(of.excess[f * of.excess_step], 0.0f);
      const auto first = of.first_texel[f];
      update_face(image, gate, in_view[k], of.divisions[f], of.mean + first, of.variance + first);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace ppm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ppm {

HWY_EXPORT(gather);

void gather_faces(const GatherImage& image, const GatherGate& gate, const GatherFaces& of, const std::uint32_t* faces,
                  std::size_t count) {
  HWY_DYNAMIC_DISPATCH(gather)(image, gate, of, faces, count);
}

}  // namespace ppm
#endif
