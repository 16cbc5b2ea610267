#include "modules/sources/jpeg_decoder.hpp"

#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <fmt/core.h>
#include <jpeglib.h>

#include "modules/sources/image_file.hpp"

namespace ppm {
namespace {

/// libjpeg's state for one image. Errors come back by longjmp, as in png_decoder.cpp: the functions that call libjpeg
/// hold no object with a destructor.
struct JpegReader {
  JpegReader() {
    info.err = jpeg_std_error(&errors);
    info.client_data = this;
    errors.error_exit = on_error;
    errors.emit_message = on_warning;
  }
  ~JpegReader() { jpeg_destroy_decompress(&info); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  [[noreturn]] static void on_error(j_common_ptr info) {
    auto* self = static_cast<JpegReader*>(info->client_data);
    self->errors.format_message(info, self->message);
    std::longjmp(self->jump, 1);
  }
  /// libjpeg goes on after warnings (negative levels) with made-up pixels: the first one is an error here.
  static void on_warning(j_common_ptr info, int level) {
    if (level < 0) on_error(info);
  }

  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  std::jmp_buf jump{};
  char message[JMSG_LENGTH_MAX] = "";
};

/// False when libjpeg jumped back with a message.
bool read_header(JpegReader& r, const std::string& file_bytes) {
  if (setjmp(r.jump)) return false;
  jpeg_create_decompress(&r.info);
  jpeg_mem_src(&r.info, reinterpret_cast<const unsigned char*>(file_bytes.data()), file_bytes.size());
  jpeg_read_header(&r.info, TRUE);
  r.info.out_color_space = JCS_RGB;
  return true;
}

bool read_rows(JpegReader& r, unsigned char* out) {
  if (setjmp(r.jump)) return false;
  jpeg_start_decompress(&r.info);
  while (r.info.output_scanline < r.info.output_height) {
    JSAMPROW row = out + std::size_t{r.info.output_scanline} * r.info.output_width * 3;
    jpeg_read_scanlines(&r.info, &row, 1);
  }
  jpeg_finish_decompress(&r.info);
  return true;
}

}  // namespace

JpegImage decode_jpeg(const std::string& file_bytes) {
  JpegImage image;
  JpegReader r;
  auto fail = [&](std::string why) {
    image.error = std::move(why);
    return image;
  };
  if (!read_header(r, file_bytes)) return fail(fmt::format("is a broken JPEG image: {}", r.message));
  if (r.info.image_width > kMaxImageSide || r.info.image_height > kMaxImageSide)
    return fail(fmt::format("is larger than {} pixels a side", kMaxImageSide));
  image.cols = static_cast<int>(r.info.image_width);
  image.rows = static_cast<int>(r.info.image_height);
  image.bytes.resize(static_cast<std::size_t>(image.cols) * static_cast<std::size_t>(image.rows) * 3);
  if (!read_rows(r, image.bytes.data())) return fail(fmt::format("is a broken JPEG image: {}", r.message));
  return image;
}

}  // namespace ppm
