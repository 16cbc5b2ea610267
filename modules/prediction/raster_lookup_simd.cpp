// Where on its face a pixel's ray arrives, and what the texels around say.
#include "modules/prediction/raster_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "modules/prediction/raster_lookup_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "modules/prediction/raster_lanes_inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace ppm {
namespace HWY_NAMESPACE {
namespace {

/// For each lane the number of lanes up to it, itself included, that are set.
VI count_up_to(hn::Mask<DI> set) {
  VI count = hn::IfThenElseZero(set, hn::Set(di, 1));
  const VI lane = hn::Iota(di, 0);
  for (std::int32_t by = 1; by < static_cast<std::int32_t>(kLanes); by *= 2) {
    const VI from = hn::Sub(lane, hn::Set(di, by));
    const VI before = hn::TableLookupLanes(count, hn::IndicesFromVec(di, hn::Max(from, hn::Zero(di))));
    count = hn::Add(count, hn::IfThenElseZero(hn::Gt(lane, hn::Set(di, by - 1)), before));
  }
  return count;
}

/// Pixels to runs of pixels that show the same.
void split(const std::uint32_t* shown, RasterRuns& runs, RasterPixels& pixels) {
  const VI last_lane = hn::Set(di, static_cast<std::int32_t>(kLanes) - 1);
  const std::int32_t* pixel = pixels.pixel();
  VI run = hn::Zero(di);
  runs.triangle[0] = shown[*pixel];
  runs.size = 1;
  for (std::size_t p = 0; p < pixels.size; p += kLanes) {
    const VU triangle = hn::GatherIndex(du, shown, hn::Load(di, pixel + p));
    const VU before = hn::GatherIndex(du, shown, hn::LoadU(di, pixel + p - 1));
    const auto starts = hn::Ne(triangle, before);  // no lane past the end: those repeat the last pixel
    run = hn::Add(run, count_up_to(hn::RebindMask(di, starts)));
    hn::Store(run, di, pixels.run + p);
    hn::StoreU(hn::Compress(triangle, starts), du, runs.triangle + runs.size);
    runs.size += hn::CountTrue(du, starts);
    run = hn::TableLookupLanes(run, hn::IndicesFromVec(di, last_lane));
  }
}

/// The quads' members side by side.
void transpose(RasterRuns& runs) {
  for (std::size_t r = 0; r < runs.size; r += kLanes)
    for (std::size_t k = 0; k < 3; ++k) {
      VF a, b, c, d;
      hn::LoadInterleaved4(df, runs.quad[k] + 4 * r, a, b, c, d);
      hn::Store(a, df, runs.member[4 * k] + r);
      hn::Store(b, df, runs.member[4 * k + 1] + r);
      hn::Store(c, df, runs.member[4 * k + 2] + r);
      hn::Store(d, df, runs.member[4 * k + 3] + r);
    }
}

/// The runs of a vector of pixels: there are no more of them than lanes.
class RunsOfPixels {
 public:
  RunsOfPixels(const RasterRuns& runs, const RasterPixels& pixels, std::size_t p)
      : runs_(runs), first_(static_cast<std::size_t>(pixels.run[p])) {
    index_ = hn::Sub(hn::Load(di, pixels.run + p), hn::Set(di, pixels.run[p]));
  }
  VF operator()(const float* values) const {
    return hn::TableLookupLanes(hn::LoadU(df, values + first_), hn::IndicesFromVec(df, index_));
  }
  VI operator()(const std::int32_t* values) const {
    return hn::TableLookupLanes(hn::LoadU(di, values + first_), hn::IndicesFromVec(di, index_));
  }
  /// a x + b y + c of one of the quads.
  VF at(std::size_t quad, VF x, VF y) const {
    const VF a = (*this)(runs_.member[4 * quad]), b = (*this)(runs_.member[4 * quad + 1]);
    return hn::Add(hn::Mul(a, x), hn::Add(hn::Mul(b, y), (*this)(runs_.member[4 * quad + 2])));
  }
  VF beside(std::size_t quad) const { return (*this)(runs_.member[4 * quad + 3]); }

 private:
  const RasterRuns& runs_;
  std::size_t first_;
  VI index_;
};

/// Image coordinates of pixels; short where they are neighbours in a row. whole: as many pixels as lanes, not a list's end
/// whose last pixel is repeated: that can have gaps and still end as far off as neighbours do.
void place(const RasterCamera& camera, const std::int32_t* pixel, bool whole, VF& x, VF& y) {
  constexpr auto lanes = static_cast<std::int32_t>(kLanes);
  const std::int32_t first_row = pixel[0] / camera.cols, first_col = pixel[0] - first_row * camera.cols;
  if (whole && pixel[lanes - 1] - pixel[0] == lanes - 1 && first_col + lanes <= camera.cols) {
    x = hn::Iota(df, static_cast<float>(first_col - camera.middle_x));
    y = hn::Set(df, static_cast<float>(first_row + camera.first_row - camera.middle_y));
    return;
  }
  const VF cols = hn::Set(df, static_cast<float>(camera.cols)), zero = hn::Zero(df), one = hn::Set(df, 1.f);
  const VF p = hn::ConvertTo(df, hn::Load(di, pixel));
  VF row = hn::Floor(hn::Mul(p, hn::Set(df, 1.f / static_cast<float>(camera.cols))));
  VF col = hn::Sub(p, hn::Mul(row, cols));
  const MF under = hn::Lt(col, zero), over = hn::Ge(col, cols);  // rounding of the quotient
  row = hn::Add(row, hn::Sub(hn::IfThenElseZero(over, one), hn::IfThenElseZero(under, one)));
  col = hn::Add(col, hn::Sub(hn::IfThenElseZero(under, cols), hn::IfThenElseZero(over, cols)));
  x = hn::Sub(col, hn::Set(df, static_cast<float>(camera.middle_x)));
  y = hn::Sub(row, hn::Set(df, static_cast<float>(camera.middle_y - camera.first_row)));
}

/// Length of the ray with unit depth.
VF ray_length(const RasterCamera& camera, VF x, VF y) {
  const VF rx = hn::Add(hn::Mul(hn::Set(df, camera.ray_x), x), hn::Set(df, camera.ray_x0));
  const VF ry = hn::Add(hn::Mul(hn::Set(df, camera.ray_y), y), hn::Set(df, camera.ray_y0));
  return hn::Sqrt(hn::Add(hn::Add(hn::Mul(rx, rx), hn::Mul(ry, ry)), hn::Set(df, 1.f)));
}

struct TexelTriangle {
  VI texel[3];
  VF weight[3];
};

/// texel_triangle() of texel_grid.hpp: the same numbers. Whole numbers are counted in floats, which hold them exactly.
TexelTriangle texels_around(VF n, VF u, VF v) {
  const VF zero = hn::Zero(df), one = hn::Set(df, 1.f), last = hn::Sub(n, one);
  const VF x = hn::Mul(hn::Min(hn::Max(u, zero), one), n), y = hn::Mul(hn::Min(hn::Max(v, zero), one), n);
  const VF i = hn::Min(hn::Floor(x), last), j = hn::Min(hn::Floor(y), hn::Sub(last, i));
  const VF a = hn::Min(hn::Sub(x, i), one), b = hn::Min(hn::Sub(y, j), one);
  const MF upper = hn::And(hn::Gt(hn::Add(a, b), one), hn::Lt(hn::Add(i, j), last));
  // Texel (i, j) has the number i (2 n + 3 - i) / 2 + j; (i, j + 1) follows it, (i + 1, j) is n + 1 - i on.
  const VF row = hn::Mul(hn::Mul(i, hn::Sub(hn::Add(hn::Add(n, n), hn::Set(df, 3.f)), i)), hn::Set(df, 0.5f));
  const VI corner = hn::NearestInt(hn::Add(row, j)), step = hn::NearestInt(hn::Sub(hn::Add(n, one), i));
  const VI beside = hn::Add(corner, hn::Set(di, 1)), below = hn::Add(corner, step);
  const VF weight1 = hn::IfThenElse(upper, hn::Sub(one, b), a), weight2 = hn::IfThenElse(upper, hn::Sub(one, a), b);
  return {{hn::IfThenElse(hn::RebindMask(di, upper), hn::Add(below, hn::Set(di, 1)), corner), below, beside},
          {hn::Max(hn::Sub(hn::Sub(one, weight1), weight2), zero), weight1, weight2}};
}

/// nearest_texel() of texel_grid.hpp, as all the weight.
void take_nearest(TexelTriangle& t) {
  const VF zero = hn::Zero(df), one = hn::Set(df, 1.f);
  const MF second = hn::Gt(t.weight[1], t.weight[0]), third = hn::Gt(t.weight[2], hn::Max(t.weight[0], t.weight[1]));
  t.weight[0] = hn::IfThenElse(hn::Or(second, third), zero, one);
  t.weight[1] = hn::IfThenElse(hn::AndNot(third, second), one, zero);
  t.weight[2] = hn::IfThenElse(third, one, zero);
}

/// Where rays arrive.
void arrive(const RasterCamera& camera, const RasterRuns& runs, RasterPixels& pixels) {
  for (std::size_t p = 0; p < pixels.size; p += kLanes) {
    const RunsOfPixels of_run(runs, pixels, p);
    VF x, y;
    place(camera, pixels.pixel() + p, p + kLanes <= pixels.size, x, y);
    const VF depth = hn::Div(hn::Set(df, 1.f), of_run.at(2, x, y)), per_edge = hn::Mul(of_run.beside(0), depth);
    hn::Store(hn::Mul(depth, ray_length(camera, x, y)), df, pixels.range + p);
    hn::Store(hn::Mul(of_run.at(0, x, y), per_edge), df, pixels.u + p);
    hn::Store(hn::Mul(of_run.at(1, x, y), per_edge), df, pixels.v + p);
  }
}

/// Which texels lie around.
void find_texels(bool linear, const RasterRuns& runs, RasterPixels& pixels) {
  for (std::size_t p = 0; p < pixels.size; p += kLanes) {
    const RunsOfPixels of_run(runs, pixels, p);
    const VF u = hn::Load(df, pixels.u + p), v = hn::Load(df, pixels.v + p);
    TexelTriangle t = texels_around(of_run(runs.divisions), u, v);
    if (!linear) take_nearest(t);
    for (std::size_t k = 0; k < 3; ++k) {
      hn::Store(t.texel[k], di, pixels.texel[k] + p);
      hn::Store(t.weight[k], df, pixels.weight[k] + p);
    }
  }
}

/// What they say, m along the normal, turned to the camera, and m^2.
void read_texels(const RasterRuns& runs, RasterPixels& pixels) {
  for (std::size_t p = 0; p < pixels.size; p += kLanes) {
    const RunsOfPixels of_run(runs, pixels, p);
    const VI first_mean = of_run(runs.mean), first_variance = of_run(runs.variance);
    VF mean = hn::Zero(df), variance = of_run(runs.added_variance);
    for (std::size_t k = 0; k < 3; ++k) {
      const VF weight = hn::Load(df, pixels.weight[k] + p);
      const VI texel = hn::Load(di, pixels.texel[k] + p);
      mean = hn::Add(mean, hn::Mul(weight, hn::GatherIndex(df, runs.mean_base, hn::Add(first_mean, texel))));
      variance =
          hn::Add(variance, hn::Mul(weight, hn::GatherIndex(df, runs.variance_base, hn::Add(first_variance, texel))));
    }
    hn::Store(hn::Xor(mean, hn::And(of_run.beside(1), hn::Set(df, -0.f))), df, pixels.mean + p);
    hn::Store(variance, df, pixels.variance + p);
  }
}

/// Range and variance of the described surface, from those of the face and along the normal.
void turn_along_rays(const RasterQuestion& question, const RasterRuns& runs, RasterPixels& pixels) {
  const VF one = hn::Set(df, 1.f), zero = hn::Zero(df), steepest = hn::Set(df, 1.f / question.least_cosine);
  for (std::size_t p = 0; p < pixels.size; p += kLanes) {
    const RunsOfPixels of_run(runs, pixels, p);
    const VF range = hn::Load(df, pixels.range + p), variance = hn::Load(df, pixels.variance + p);
    const VF stretch = hn::Min(hn::Mul(range, hn::Abs(of_run.beside(1))), steepest);  // 1 / cosine
    const VF expected = hn::Sub(range, hn::Mul(hn::Load(df, pixels.mean + p), stretch));
    const MF miss = hn::Lt(of_run(runs.added_variance), zero);
    hn::Store(hn::IfThenElse(miss, hn::Set(df, question.miss), expected), df, pixels.range + p);
    hn::Store(hn::IfThenElse(miss, zero, hn::Mul(variance, hn::Mul(stretch, stretch))), df, pixels.variance + p);
    hn::Store(hn::IfThenElse(miss, one, hn::Div(one, stretch)), df, pixels.cosine + p);
  }
}

// One step for all pixels at a time, so that the processor works on many pixels at once.
void look_up(const RasterCamera& camera, const RasterQuestion& question, RasterRuns& runs, RasterPixels& pixels) {
  transpose(runs);
  arrive(camera, runs, pixels);
  find_texels(question.linear_texels, runs, pixels);
  read_texels(runs, pixels);
  if (question.along_ray) turn_along_rays(question, runs, pixels);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace ppm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ppm {
HWY_EXPORT(split);
HWY_EXPORT(look_up);

void raster_split(const std::uint32_t* shown, RasterRuns& runs, RasterPixels& pixels) {
  HWY_DYNAMIC_DISPATCH(split)(shown, runs, pixels);
}

void raster_look_up(const RasterCamera& camera, const RasterQuestion& question, RasterRuns& runs,
                    RasterPixels& pixels) {
  HWY_DYNAMIC_DISPATCH(look_up)(camera, question, runs, pixels);
}
}  // namespace ppm
#endif
