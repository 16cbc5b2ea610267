#include "modules/prediction/raster_lookup.hpp"

#include <cmath>
#include <cstring>

#include "modules/maps/ppm/chunk.hpp"

namespace ppm {
namespace {

// A face that is looked up for pixels without one.
constexpr float kNoTriangle[3][4] = {{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}};
constexpr float kNoTexels[3] = {0, 0, 0};

}  // namespace

void RasterLookup::find(const RasterBand& band, std::span<const std::uint32_t> pixels) {
  gather(band, pixels);
  raster_locate(camera_, linear_texels_, at);
  read_texels();
}

void RasterLookup::gather(const RasterBand& band, std::span<const std::uint32_t> pixels) {
  const auto cols = static_cast<std::uint32_t>(camera_.cols);
  const std::uint32_t top = static_cast<std::uint32_t>(band.first_row) * cols;
  std::uint32_t row = pixels.front() / cols, row_end = (row + 1) * cols;
  at.size = pixels.size();
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    while (pixels[i] >= row_end) ++row, row_end += cols;
    at.x[i] = static_cast<float>(static_cast<int>(pixels[i] + cols - row_end) - camera_.middle_x);
    at.y[i] = static_cast<float>(static_cast<int>(row) - camera_.middle_y);
    take(band, i, band.shown.data()[pixels[i] - top]);
  }
}

void RasterLookup::take(const RasterBand& band, std::size_t i, std::uint32_t triangle) {
  if (triangle == RasterBand::kNone) {
    for (int k = 0; k < 3; ++k) std::memcpy(at.quad[k] + 4 * i, kNoTriangle[k], sizeof kNoTriangle[k]);
    at.divisions[i] = 1;
    element[i] = {nullptr, 0, 1, 0, kNoTexels, kNoTexels};
    return;
  }
  const std::size_t first = 4 * std::size_t{triangle};
  for (int k = 0; k < 3; ++k) std::memcpy(at.quad[k] + 4 * i, band.quad[k].data() + first, sizeof kNoTriangle[k]);
  const RasterTexels& texels = band.texels_of(triangle);
  const std::uint32_t face = band.face_of(triangle);
  const std::uint32_t texel = texels.first_texel[face];
  at.divisions[i] = texels.divisions[face];
  element[i] = {&texels,
                face,
                std::copysign(1.f, band.quad[1].data()[first + 3]),
                texels.evidence[face].added_variance(),
                texels.mean + texel,
                texels.variance + texel};
}

void RasterLookup::read_texels() {
  for (std::size_t i = 0; i < at.size; ++i) {
    const Element& e = element[i];
    float m = 0, v = e.added_variance;
    for (int k = 0; k < 3; ++k) {
      m += at.weight[k][i] * e.mean[at.texel[k][i]];
      v += at.weight[k][i] * e.variance[at.texel[k][i]];
    }
    mean[i] = e.side * m;
    variance[i] = v;
  }
}

}  // namespace ppm
