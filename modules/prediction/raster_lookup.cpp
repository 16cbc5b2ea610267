#include "modules/prediction/raster_lookup.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <hwy/cache_control.h>
#include <limits>

#include "modules/maps/ppm/chunk.hpp"

namespace ppm {
namespace {

// A face that is looked up for pixels without one.
constexpr float kNoTriangle[3][4] = {{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}};
constexpr float kNoTexels[3] = {};
constexpr std::size_t kQuad = sizeof kNoTriangle[0];

/// The distance between two places in memory, in floats; false where it does not fit.
inline bool offset(const float* from, const float* to, std::int32_t& floats) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max() / 2;  // room for texels of a face
  const std::int64_t bytes = reinterpret_cast<std::intptr_t>(to) - reinterpret_cast<std::intptr_t>(from);
  const std::int64_t count = bytes / static_cast<std::int64_t>(sizeof(float));
  floats = static_cast<std::int32_t>(count);
  return std::abs(count) < most;
}

}  // namespace

std::size_t RasterLookup::find(const RasterBand& band, std::span<const std::uint32_t> pixels) {
  take(band, pixels.first(std::min(pixels.size(), RasterRuns::kMost)));
  raster_split(band.shown.data(), runs_, at);
  copy_triangles(band);
  const std::size_t reached = read_faces();
  if (reached < runs_.size) {  // the rest is looked up from other bases
    runs_.size = reached;
    const auto* end = std::lower_bound(at.run, at.run + at.size, static_cast<std::int32_t>(reached));
    at.size = static_cast<std::size_t>(end - at.run);
    std::fill_n(at.run + at.size, RasterBand::kSpare, at.run[at.size - 1]);
  }
  if (!runs_.mean_base) runs_.mean_base = runs_.variance_base = kNoTexels;
  camera_.first_row = band.first_row;
  raster_look_up(camera_, question_, runs_, at);
  return at.size;
}

void RasterLookup::take(const RasterBand& band, std::span<const std::uint32_t> pixels) {
  const auto top = static_cast<std::uint32_t>(band.first_row * camera_.cols);
  std::int32_t* pixel = at.pixel();
  for (std::size_t i = 0; i < pixels.size(); ++i) pixel[i] = static_cast<std::int32_t>(pixels[i] - top);
  at.size = pixels.size();
  pixel[-1] = pixel[0];
  std::fill_n(pixel + at.size, RasterBand::kSpare, pixel[at.size - 1]);
}

/// The triangles of the runs; asks for what the next step reads.
void RasterLookup::copy_triangles(const RasterBand& band) {
  for (std::size_t run = 0; run < runs_.size; ++run) {
    const std::uint32_t triangle = runs_.triangle[run];
    const bool miss = triangle == RasterBand::kNone;
    for (int k = 0; k < 3; ++k)
      std::memcpy(runs_.quad[k] + 4 * run, miss ? kNoTriangle[k] : band.quad[k].data() + 4 * std::size_t{triangle},
                  kQuad);
    Face& f = face_[run];
    f = {};
    if (miss) continue;
    f = {&band.texels_of(triangle), band.face_of(triangle), std::copysign(1.f, runs_.quad[1][4 * run + 3])};
    hwy::Prefetch(f.texels->first_texel + f.face);
    hwy::Prefetch(f.texels->evidence + f.face);
    hwy::Prefetch(f.texels->divisions + f.face);
  }
}

/// What is known of the runs' faces; asks for their texels. Says how many runs can be looked up together.
std::size_t RasterLookup::read_faces() {
  runs_.mean_base = runs_.variance_base = nullptr;
  for (std::size_t run = 0; run < runs_.size; ++run) {
    const auto [texels, face, side] = face_[run];
    if (!texels) {
      runs_.divisions[run] = 1;
      runs_.added_variance[run] = -1;
      runs_.mean[run] = runs_.variance[run] = 0;  // of whatever face: there are three texels at least
      continue;
    }
    const std::uint32_t first = texels->first_texel[face], divisions = texels->divisions[face];
    const float *mean = texels->mean + first, *variance = texels->variance + first;
    if (!runs_.mean_base) runs_.mean_base = mean, runs_.variance_base = variance;
    if (!offset(runs_.mean_base, mean, runs_.mean[run]) || !offset(runs_.variance_base, variance, runs_.variance[run]))
      return run;
    runs_.divisions[run] = static_cast<float>(divisions);
    runs_.added_variance[run] = texels->evidence[face].added_variance();
    for (std::uint32_t t = 0; t < texel_count(divisions); t += 16) {
      hwy::Prefetch(mean + t);
      hwy::Prefetch(variance + t);
    }
  }
  return runs_.size;
}

}  // namespace ppm
