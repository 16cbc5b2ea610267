#include "modules/prediction/raster_view.hpp"

#include <algorithm>
#include <numeric>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/color_sample.hpp"
#include "modules/prediction/raster_camera.hpp"
#include "modules/prediction/raster_lookup.hpp"

namespace ppm {
namespace {

/// Writes colour [channels] and its variance at a pixel that shows a face.
void read_color(const PpmMap& map, bool linear, const RasterLookup& seen, std::size_t i, std::size_t channels,
                float* color, float* variance) {
  const auto& e = seen.element[i];
  const PpmChunk& chunk = map.table()[e.texels->chunk];
  const float u = seen.at.u[i], v = seen.at.v[i];
  const ColorSample c = linear ? linear_color(*chunk.geometry, *chunk.texels, e.face, u, v)
                               : nearest_color(*chunk.geometry, *chunk.texels, e.face, u, v);
  std::copy_n(c.mean.begin(), channels, color);
  *variance = c.variance;
}

void write_sample(const RasterLookup& seen, std::size_t i, ViewSamples& out, std::size_t at) {
  constexpr auto least = static_cast<float>(Prediction::kMinCosine);
  const bool miss = !seen.element[i].texels;
  const float c = std::max(seen.at.cosine[i], least);
  out.range[at] = miss ? Prediction::kMiss : seen.at.range[i] - seen.mean[i] / c;
  out.variance[at] = miss ? 0.f : seen.variance[i] / (c * c);
  out.cosine[at] = miss ? 1.f : c;
}

void write_pixel(const RasterLookup& seen, std::size_t i, const Eigen::Vector3f& normal, Prediction& out,
                 std::size_t p) {
  const auto& e = seen.element[i];
  out.range[p] = seen.at.range[i];
  out.mean[p] = seen.mean[i];
  out.variance[p] = seen.variance[i];
  for (int k = 0; k < 3; ++k) out.normal[3 * p + static_cast<std::size_t>(k)] = e.side * normal[k];
  out.chunk[p] = e.texels->chunk;
  out.face[p] = e.face;
  out.bary[2 * p] = seen.at.u[i];
  out.bary[2 * p + 1] = seen.at.v[i];
}

}  // namespace

void RasterView::start(const PpmMap& map, const Prediction& view, const RasterOptions& options) {
  PPM_CHECK(view.color_channels == 0 || view.color_channels == map.color_channels(),
            "a view with {} channels of colour of a map with {}", view.color_channels, map.color_channels());
  map_ = &map;
  options_ = options;
  camera_ = raster_camera(view.camera, view.T_map_camera, options.cull_back_faces);
  bands_used_ = 0;
  band_of_row_.assign(static_cast<std::size_t>(view.camera.rows), nullptr);
}

RasterBand& RasterView::add_band(const Rows& rows) {
  std::lock_guard lock(mutex_);
  if (bands_used_ == bands_.size()) bands_.push_back(std::make_unique<RasterBand>());
  RasterBand& band = *bands_[bands_used_++];
  for (int y = rows.first; y < rows.end; ++y) band_of_row_[static_cast<std::size_t>(y)] = &band;
  band.first_row = rows.first;
  band.end_row = rows.end;
  return band;
}

template <class Body>
void RasterView::look_up(std::span<const std::uint32_t> pixels, const Body& body) const {
  RasterLookup lookup(camera_, options_.linear_texels);
  const auto cols = static_cast<std::uint32_t>(camera_.cols);
  for (std::size_t first = 0; first < pixels.size();) {
    const RasterBand* band = band_of_row_[pixels[first] / cols];
    PPM_CHECK(band, "row {} was not drawn", pixels[first] / cols);
    const auto part = pixels.subspan(first, std::min(pixels.size() - first, RasterPixels::kMost));
    const auto end = static_cast<std::uint32_t>(band->end_row) * cols;
    const auto count = static_cast<std::size_t>(std::lower_bound(part.begin(), part.end(), end) - part.begin());
    lookup.find(*band, part.first(count));
    body(lookup, first, count);
    first += count;
  }
}

void RasterView::sample(const Prediction&, std::span<const std::uint32_t> pixels, ViewSamples& out) const {
  const auto channels = static_cast<std::size_t>(out.color_channels);
  std::fill(out.color.begin(), out.color.end(), 0.0f);
  std::fill(out.color_variance.begin(), out.color_variance.end(), 0.0f);
  look_up(pixels, [&](const RasterLookup& seen, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) write_sample(seen, i, out, first + i);
    for (std::size_t i = 0; channels > 0 && i < count; ++i)
      if (seen.element[i].texels)
        read_color(*map_, options_.linear_texels, seen, i, channels, &out.color[channels * (first + i)],
                   &out.color_variance[first + i]);
  });
}

void RasterView::fill(const Prediction&, const Rows& rows, Prediction& out) const {
  const auto channels = static_cast<std::size_t>(out.color_channels);
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(rows.end - rows.first) *
                                    static_cast<std::size_t>(camera_.cols));
  std::iota(pixels.begin(), pixels.end(), static_cast<std::uint32_t>(rows.first * camera_.cols));
  const RasterTexels* chunk = nullptr;
  std::uint32_t face = 0;
  Eigen::Vector3f normal;  // of the last face: often the next pixel's too
  look_up(pixels, [&](const RasterLookup& seen, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto& e = seen.element[i];
      const std::size_t p = pixels[first + i];
      if (!e.texels) continue;
      if (e.texels != chunk || e.face != face) normal = map_->table()[e.texels->chunk].geometry->face_normal(e.face);
      chunk = e.texels;
      face = e.face;
      write_pixel(seen, i, normal, out, p);
      if (channels > 0)
        read_color(*map_, options_.linear_texels, seen, i, channels, &out.color[channels * p], &out.color_variance[p]);
    }
  });
}

void RasterView::elements(const Prediction&, const Rows& rows, std::span<std::uint32_t> chunk,
                          std::span<std::uint32_t> face) const {
  const auto cols = static_cast<std::size_t>(camera_.cols);
  PPM_CHECK(chunk.size() == cols * static_cast<std::size_t>(rows.end - rows.first) && face.size() == chunk.size(),
            "{} and {} elements of {} rows", chunk.size(), face.size(), rows.end - rows.first);
  std::size_t p = 0;
  for (int y = rows.first; y < rows.end; ++y) {
    const RasterBand* band = band_of_row_[static_cast<std::size_t>(y)];
    PPM_CHECK(band, "row {} was not drawn", y);
    const std::uint32_t* shown = band->shown.data() + static_cast<std::size_t>(y - band->first_row) * cols;
    for (std::size_t x = 0; x < cols; ++x, ++p) {
      const bool miss = shown[x] == RasterBand::kNone;
      chunk[p] = miss ? Prediction::kNone : band->texels_of(shown[x]).chunk;
      face[p] = miss ? Prediction::kNone : band->face_of(shown[x]);
    }
  }
}

}  // namespace ppm
