#include "modules/maps/picture/thumbnail.hpp"

#include <png.h>

#include "framework/core/error.hpp"

namespace ppm {

RgbImage from_png(std::string_view bytes, const std::string& file) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  const png_color white{255, 255, 255};
  RgbImage image;
  bool read = png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) != 0;
  if (read) {
    header.format = PNG_FORMAT_RGB;
    image = {static_cast<int>(header.width), static_cast<int>(header.height), {}};
    image.rgb.resize(PNG_IMAGE_SIZE(header));
    read = png_image_finish_read(&header, &white, image.rgb.data(), 0, nullptr) != 0;
  }
  if (!read) {
    const std::string reason = header.message;
    png_image_free(&header);
    throw DataError(file, reason);
  }
  return image;
}

RgbImage shrunk(const RgbImage& image, int most_cols) {
  PPM_CHECK(most_cols > 0, "{} columns", most_cols);
  const int block = (image.cols + most_cols - 1) / most_cols;
  if (block <= 1) return image;
  RgbImage small{image.cols / block, image.rows / block, {}};
  for (int y = 0; y < small.rows; ++y) {
    for (int x = 0; x < small.cols; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int v = y * block; v < (y + 1) * block; ++v)
          for (int u = x * block; u < (x + 1) * block; ++u)
            sum += image.rgb[static_cast<std::size_t>(3 * (v * image.cols + u) + channel)];
        small.rgb.push_back(static_cast<std::uint8_t>((sum + block * block / 2) / (block * block)));
      }
    }
  }
  return small;
}

}  // namespace ppm
