#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <jpeglib.h>
#include <png.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace ppm::test {

inline std::string file_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// format: PNG_FORMAT_LINEAR_Y (16-bit gray, values as they are), PNG_FORMAT_GRAY, PNG_FORMAT_RGB, ...
inline void write_png(const std::filesystem::path& file, int cols, int rows, png_uint_32 format, const void* pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(cols);
  image.height = static_cast<png_uint_32>(rows);
  image.format = format;
  if (!png_image_write_to_file(&image, file.c_str(), 0, pixels, 0, nullptr)) throw std::runtime_error(image.message);
}
inline void write_gray16(const std::filesystem::path& file, int cols, int rows,
                         const std::vector<std::uint16_t>& pixels) {
  write_png(file, cols, rows, PNG_FORMAT_LINEAR_Y, pixels.data());
}
inline void write_rgb(const std::filesystem::path& file, int cols, int rows, const std::vector<std::uint8_t>& pixels) {
  write_png(file, cols, rows, PNG_FORMAT_RGB, pixels.data());
}

inline void write_jpeg(const std::filesystem::path& file, int cols, int rows, std::vector<std::uint8_t> rgb) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  std::FILE* out = std::fopen(file.c_str(), "wb");
  jpeg_stdio_dest(&jpeg, out);
  jpeg.image_width = static_cast<JDIMENSION>(cols);
  jpeg.image_height = static_cast<JDIMENSION>(rows);
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  for (int y = 0; y < rows; ++y) {
    JSAMPROW row = rgb.data() + y * cols * 3;
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::fclose(out);
}

}  // namespace ppm::test
