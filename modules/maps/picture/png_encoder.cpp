#include "modules/maps/picture/png_encoder.hpp"

#include <png.h>

#include "framework/core/error.hpp"

namespace ppm {

std::string to_png(const RgbImage& image, PngEffort effort) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.cols);
  header.height = static_cast<png_uint_32>(image.rows);
  header.format = PNG_FORMAT_RGB;
  if (effort == PngEffort::fast) header.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  const int written = png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr);
  PPM_CHECK(written != 0, "libpng: {}", header.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace ppm
