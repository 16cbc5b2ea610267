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
  const PpmChunk& chunk = map.table()[seen.face(i).texels->chunk];
  const std::uint32_t f = seen.face(i).face;
  const ColorSample c = linear ? linear_color(*chunk.geometry, *chunk.texels, f, seen.at.u[i], seen.at.v[i])
                               : nearest_color(*chunk.geometry, *chunk.texels, f, seen.at.u[i], seen.at.v[i]);
  std::copy_n(c.mean.begin(), channels, color);
  *variance = c.variance;
}

void write_pixel(const RasterLookup& seen, std::size_t i, const Eigen::Vector3f& normal, Prediction& out,
                 std::size_t p) {
  out.range[p] = seen.at.range[i];
  out.mean[p] = seen.at.mean[i];
  out.variance[p] = seen.at.variance[i];
  Eigen::Map<Eigen::Vector3f>(&out.normal[3 * p]) = normal;
  out.chunk[p] = seen.face(i).texels->chunk;
  out.face[p] = seen.face(i).face;
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

RasterQuestion RasterView::question(bool along_ray) const {
  return {options_.linear_texels, along_ray, static_cast<float>(Prediction::kMinCosine), Prediction::kMiss};
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
void RasterView::look_up(const RasterQuestion& question, std::span<const std::uint32_t> pixels,
                         const Body& body) const {
  RasterLookup lookup(camera_, question);
  const auto cols = static_cast<std::uint32_t>(camera_.cols);
  for (std::size_t first = 0; first < pixels.size();) {
    const RasterBand* band = band_of_row_[pixels[first] / cols];
    PPM_CHECK(band, "row {} was not drawn", pixels[first] / cols);
    auto part = pixels.subspan(first);  // of the band
    const auto end = std::lower_bound(part.begin(), part.end(), static_cast<std::uint32_t>(band->end_row) * cols);
    for (part = part.first(static_cast<std::size_t>(end - part.begin())); !part.empty();) {
      const std::size_t count = lookup.find(*band, part);
      body(lookup, first);
      first += count;
      part = part.subspan(count);
    }
  }
}

void RasterView::sample(const Prediction&, std::span<const std::uint32_t> pixels, ViewSamples& out) const {
  const auto channels = static_cast<std::size_t>(out.color_channels);
  std::fill(out.color.begin(), out.color.end(), 0.0f);
  std::fill(out.color_variance.begin(), out.color_variance.end(), 0.0f);
  look_up(question(true), pixels, [&](const RasterLookup& seen, std::size_t first) {
    std::copy_n(seen.at.range, seen.at.size, &out.range[first]);
    std::copy_n(seen.at.variance, seen.at.size, &out.variance[first]);
    std::copy_n(seen.at.cosine, seen.at.size, &out.cosine[first]);
    for (std::size_t i = 0; channels > 0 && i < seen.at.size; ++i)
      if (seen.face(i).texels)
        read_color(*map_, options_.linear_texels, seen, i, channels, &out.color[channels * (first + i)],
                   &out.color_variance[first + i]);
  });
}

void RasterView::fill(const Prediction&, const Rows& rows, Prediction& out) const {
  const auto channels = static_cast<std::size_t>(out.color_channels);
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(rows.end - rows.first) *
                                    static_cast<std::size_t>(camera_.cols));
  std::iota(pixels.begin(), pixels.end(), static_cast<std::uint32_t>(rows.first * camera_.cols));
  look_up(question(false), pixels, [&](const RasterLookup& seen, std::size_t first) {
    std::int32_t run = -1;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // of the run
    for (std::size_t i = 0; i < seen.at.size; ++i) {
      const auto& f = seen.face(i);
      if (!f.texels) continue;
      if (seen.at.run[i] != run) normal = f.side * map_->table()[f.texels->chunk].geometry->face_normal(f.face);
      run = seen.at.run[i];
      const std::size_t p = pixels[first + i];
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
    std::uint32_t last = RasterBand::kNone, its_chunk = Prediction::kNone, its_face = Prediction::kNone;
    for (std::size_t x = 0; x < cols; ++x, ++p) {
      if (shown[x] != last) {  // neighbours often show one triangle
        last = shown[x];
        const bool miss = last == RasterBand::kNone;
        its_chunk = miss ? Prediction::kNone : band->texels_of(last).chunk;
        its_face = miss ? Prediction::kNone : band->face_of(last);
      }
      chunk[p] = its_chunk;
      face[p] = its_face;
    }
  }
}

}  // namespace ppm
