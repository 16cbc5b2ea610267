#include "modules/sources/image_file.hpp"

#include <cstring>

#include "framework/core/error.hpp"
#include "modules/sources/file_bytes.hpp"
#include "modules/sources/jpeg_decoder.hpp"
#include "modules/sources/png_decoder.hpp"

namespace ppm {

GrayImage16 read_gray16_png(const std::filesystem::path& file, std::int64_t frame) {
  PngImage png = decode_png(read_bytes(file, frame), PngFormat::gray16);
  if (!png.error.empty()) throw DataError(file.string(), frame, png.error);
  GrayImage16 image{png.cols, png.rows, std::vector<std::uint16_t>(png.bytes.size() / 2)};
  std::memcpy(image.pixels.data(), png.bytes.data(), png.bytes.size());
  return image;
}

RgbImage read_rgb_image(const std::filesystem::path& file, std::int64_t frame) {
  const std::string bytes = read_bytes(file, frame);
  if (bytes.starts_with("\xff\xd8")) {
    JpegImage jpeg = decode_jpeg(bytes);
    if (!jpeg.error.empty()) throw DataError(file.string(), frame, jpeg.error);
    return {jpeg.cols, jpeg.rows, std::move(jpeg.bytes)};
  }
  if (!bytes.starts_with("\x89PNG")) throw DataError(file.string(), frame, "is neither a JPEG nor a PNG image");
  PngImage png = decode_png(bytes, PngFormat::rgb8);
  if (!png.error.empty()) throw DataError(file.string(), frame, png.error);
  return {png.cols, png.rows, std::move(png.bytes)};
}

}  // namespace ppm
