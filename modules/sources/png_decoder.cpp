#include "modules/sources/png_decoder.hpp"

#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <fmt/core.h>
#include <png.h>

#include "modules/sources/image_file.hpp"

namespace ppm {
namespace {

/// libpng's state for one image. libpng reports errors by longjmp, so the functions that call it (read_header,
/// read_rows) hold no object with a destructor: all that must be freed lives here, above them.
struct PngReader {
  explicit PngReader(const std::string& file_bytes) : data(file_bytes.data()), size(file_bytes.size()) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png) info = png_create_info_struct(png);
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    auto* self = static_cast<PngReader*>(png_get_error_ptr(png));
    std::snprintf(self->message, sizeof self->message, "%s", message);
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}  // of chunks that do not touch the pixels
  static void on_read(png_structp png, png_bytep out, std::size_t n) {
    auto* self = static_cast<PngReader*>(png_get_io_ptr(png));
    if (n > self->size - self->position) png_error(png, "the file is cut short");
    std::memcpy(out, self->data + self->position, n);
    self->position += n;
  }

  png_structp png = nullptr;
  png_infop info = nullptr;
  const char* data;
  std::size_t size, position = 0;
  char message[160] = "out of memory";
};

void convert_to_rgb8(PngReader& r) {
  png_set_expand(r.png);
  png_set_scale_16(r.png);
  png_set_strip_alpha(r.png);
  png_set_gray_to_rgb(r.png);
}

/// False when libpng jumped back with a message.
bool read_header(PngReader& r, PngFormat format) {
  if (setjmp(png_jmpbuf(r.png))) return false;
  png_set_read_fn(r.png, &r, PngReader::on_read);
  png_set_user_limits(r.png, kMaxImageSide, kMaxImageSide);
  png_read_info(r.png, r.info);
  if (format == PngFormat::rgb8)
    convert_to_rgb8(r);
  else if (std::endian::native == std::endian::little)
    png_set_swap(r.png);
  png_set_interlace_handling(r.png);
  return true;
}

/// After the format was found right: applies the conversions.
bool read_rows(PngReader& r, png_bytepp rows) {
  if (setjmp(png_jmpbuf(r.png))) return false;
  png_read_update_info(r.png, r.info);
  png_read_image(r.png, rows);
  png_read_end(r.png, nullptr);
  return true;
}

std::string kind_of(const PngReader& r) {
  const char* color = "colour";
  switch (png_get_color_type(r.png, r.info)) {
    case PNG_COLOR_TYPE_GRAY:
      color = "gray";
      break;
    case PNG_COLOR_TYPE_GRAY_ALPHA:
      color = "gray with alpha";
      break;
    case PNG_COLOR_TYPE_PALETTE:
      color = "palette";
      break;
    default:
      break;
  }
  return fmt::format("{}-bit {}", png_get_bit_depth(r.png, r.info), color);
}

}  // namespace

PngImage decode_png(const std::string& file_bytes, PngFormat format) {
  PngImage image;
  PngReader r(file_bytes);
  auto fail = [&](std::string why) {
    image.error = std::move(why);
    return image;
  };
  if (!r.info) return fail("libpng cannot start");
  if (file_bytes.empty()) return fail("is empty");
  if (png_sig_cmp(reinterpret_cast<png_const_bytep>(r.data), 0, std::min<std::size_t>(8, r.size)) != 0)
    return fail("is no PNG image");
  if (!read_header(r, format)) return fail(fmt::format("is a broken PNG image: {}", r.message));
  if (format == PngFormat::gray16 &&
      (png_get_bit_depth(r.png, r.info) != 16 || png_get_color_type(r.png, r.info) != PNG_COLOR_TYPE_GRAY))
    return fail(fmt::format("is a PNG image of {}; depth must be 16-bit gray", kind_of(r)));

  image.cols = static_cast<int>(png_get_image_width(r.png, r.info));
  image.rows = static_cast<int>(png_get_image_height(r.png, r.info));
  const std::size_t row_bytes = static_cast<std::size_t>(image.cols) * (format == PngFormat::gray16 ? 2 : 3);
  image.bytes.resize(row_bytes * static_cast<std::size_t>(image.rows));
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.rows; ++y) rows.push_back(image.bytes.data() + row_bytes * static_cast<std::size_t>(y));
  if (!read_rows(r, rows.data())) return fail(fmt::format("is a broken PNG image: {}", r.message));
  return image;
}

}  // namespace ppm
