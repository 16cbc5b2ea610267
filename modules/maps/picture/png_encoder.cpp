#include "modules/maps/picture/png_encoder.hpp"

#include <png.h>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

/// palette: of a format without one, null.
std::string written(png_image& header, const void* pixels, const void* palette) {
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  const int done = png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels, 0, palette);
  PPM_CHECK(done != 0, "libpng: {}", header.message);
  bytes.resize(size);
  return bytes;
}

png_image header_of(int cols, int rows, png_uint_32 format) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(cols);
  header.height = static_cast<png_uint_32>(rows);
  header.format = format;
  return header;
}

}  // namespace

std::string to_png(const RgbImage& image, PngEffort effort) {
  auto header = header_of(image.cols, image.rows, PNG_FORMAT_RGB);
  if (effort == PngEffort::fast) header.flags = PNG_IMAGE_FLAG_FAST;
  return written(header, image.rgb.data(), nullptr);
}

std::string to_png(const PaletteImage& image) {
  auto header = header_of(image.cols, image.rows, PNG_FORMAT_RGB_COLORMAP);
  header.colormap_entries = static_cast<png_uint_32>(image.palette.size());
  return written(header, image.index.data(), image.palette.data());
}

}  // namespace ppm
