#include "modules/prediction/element_view.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/color_sample.hpp"
#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/maps/ppm/texel_sample.hpp"

namespace ppm {

namespace {

TexelSample texel_at(bool linear, const PpmChunk& chunk, std::uint32_t f, float u, float v) {
  return linear ? linear_sample(*chunk.geometry, *chunk.texels, f, u, v)
                : nearest_sample(*chunk.geometry, *chunk.texels, f, u, v);
}

ColorSample color_at(bool linear, const PpmChunk& chunk, std::uint32_t f, float u, float v) {
  return linear ? linear_color(*chunk.geometry, *chunk.texels, f, u, v)
                : nearest_color(*chunk.geometry, *chunk.texels, f, u, v);
}

}  // namespace

void ElementHits::reset(std::size_t pixels) {
  for (auto* array : {&range, &u, &v, &facing}) array->resize(pixels);
  face.resize(pixels);
  chunk.assign(pixels, Prediction::kNone);
}

void ElementView::start(const PpmMap& map, bool linear_texels, std::size_t pixels) {
  map_ = &map;
  linear_texels_ = linear_texels;
  hits_.reset(pixels);
}

void sample_hit(const PpmMap& map, bool linear_texels, const ElementHits& hits, std::size_t at, std::size_t i,
                ViewSamples& out) {
  const auto channels = static_cast<std::size_t>(out.color_channels);
  if (hits.chunk[at] == Prediction::kNone) {
    out.range[i] = Prediction::kMiss, out.variance[i] = 0, out.cosine[i] = 1;
    std::fill_n(out.color.begin() + static_cast<std::ptrdiff_t>(channels * i), channels, 0.0f);
    if (channels > 0) out.color_variance[i] = 0;
    return;
  }
  const PpmChunk& chunk = map.table()[hits.chunk[at]];
  const TexelSample texel = texel_at(linear_texels, chunk, hits.face[at], hits.u[at], hits.v[at]);
  const float c = std::max(std::abs(hits.facing[at]), static_cast<float>(Prediction::kMinCosine));
  out.range[i] = hits.range[at] - (hits.facing[at] < 0 ? -texel.mean : texel.mean) / c;
  out.variance[i] = texel.variance / (c * c);
  out.cosine[i] = c;
  if (channels == 0) return;
  const ColorSample color = color_at(linear_texels, chunk, hits.face[at], hits.u[at], hits.v[at]);
  std::copy_n(color.mean.begin(), channels, &out.color[channels * i]);
  out.color_variance[i] = color.variance;
}

void fill_hit(const PpmMap& map, bool linear_texels, const ElementHits& hits, std::size_t at,
              const Eigen::Vector3f& normal, std::size_t p, Prediction& out) {
  const PpmChunk& chunk = map.table()[hits.chunk[at]];
  const std::uint32_t f = hits.face[at];
  const float u = hits.u[at], v = hits.v[at], side = hits.facing[at] < 0 ? -1.f : 1.f;
  const TexelSample texel = texel_at(linear_texels, chunk, f, u, v);
  out.range[p] = hits.range[at];
  out.mean[p] = side * texel.mean;  // along the turned normal
  out.variance[p] = texel.variance;
  for (int k = 0; k < 3; ++k) out.normal[3 * p + static_cast<std::size_t>(k)] = side * normal[k];
  out.chunk[p] = hits.chunk[at];
  out.face[p] = f;
  out.bary[2 * p] = u;
  out.bary[2 * p + 1] = v;
  if (out.color_channels == 0) return;
  const ColorSample color = color_at(linear_texels, chunk, f, u, v);
  const auto n = static_cast<std::size_t>(out.color_channels);
  std::copy_n(color.mean.begin(), n, &out.color[n * p]);
  out.color_variance[p] = color.variance;
}

void ElementView::sample(const Prediction&, std::span<const std::uint32_t> pixels, ViewSamples& out) const {
  for (std::size_t i = 0; i < pixels.size(); ++i) sample_hit(*map_, linear_texels_, hits_, pixels[i], i, out);
}

void ElementView::fill(const Prediction& view, const Rows& rows, Prediction& out) const {
  PPM_CHECK(view.color_channels == 0 || view.color_channels == map_->color_channels(),
            "a view with {} channels of colour of a map with {}", view.color_channels, map_->color_channels());
  const auto cols = static_cast<std::size_t>(view.camera.cols);
  std::uint32_t last_chunk = Prediction::kNone, last_face = Prediction::kNone;
  Eigen::Vector3f normal;  // of the last face: often the next pixel's too
  for (auto p = static_cast<std::size_t>(rows.first) * cols; p < static_cast<std::size_t>(rows.end) * cols; ++p) {
    const std::uint32_t c = hits_.chunk[p], f = hits_.face[p];
    if (c == Prediction::kNone) continue;
    if (c != last_chunk || f != last_face) normal = map_->table()[c].geometry->face_normal(f);
    last_chunk = c;
    last_face = f;
    fill_hit(*map_, linear_texels_, hits_, p, normal, p, out);
  }
}

void ElementView::elements(const Prediction& view, const Rows& rows, std::span<std::uint32_t> chunk,
                           std::span<std::uint32_t> face) const {
  const auto first = static_cast<std::size_t>(rows.first) * static_cast<std::size_t>(view.camera.cols);
  PPM_CHECK(chunk.size() == face.size() && first + face.size() <= hits_.face.size(),
            "{} and {} elements of rows {} to {}", chunk.size(), face.size(), rows.first, rows.end);
  std::copy_n(&hits_.chunk[first], chunk.size(), chunk.begin());
  for (std::size_t i = 0; i < face.size(); ++i)
    face[i] = chunk[i] == Prediction::kNone ? Prediction::kNone : hits_.face[first + i];
}

}  // namespace ppm
