#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "modules/sources/image_file.hpp"
#include "tests/sources/image_writer.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

std::vector<std::uint16_t> some_depths(int n) {
  std::vector<std::uint16_t> depths;
  for (int i = 0; i < n; ++i) depths.push_back(static_cast<std::uint16_t>(i * 40503u));  // all bits in use
  return depths;
}

std::string error_of(const std::filesystem::path& file) {
  try {
    read_gray16_png(file, 7);
  } catch (const DataError& e) {
    return e.what();
  }
  return "no error";
}

std::string rgb_error_of(const std::filesystem::path& file) {
  try {
    read_rgb_image(file, 7);
  } catch (const DataError& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a 16-bit PNG gives the values that were written") {
  const TempFolder folder;
  const auto depths = some_depths(31 * 17);
  write_gray16(folder / "a.png", 31, 17, depths);
  const GrayImage16 image = read_gray16_png(folder / "a.png", 0);
  CHECK(image.cols == 31);
  CHECK(image.rows == 17);
  CHECK(image.pixels == depths);
}

TEST_CASE("depth images of the wrong kind are refused with the reason") {
  const TempFolder folder;
  const auto file = folder / "d.png";
  const std::string prefix = file.string() + " (frame 7): ";
  const std::vector<std::uint8_t> bytes(8 * 4 * 3, 90);
  write_png(file, 8, 4, PNG_FORMAT_GRAY, bytes.data());
  CHECK(error_of(file) == prefix + "is a PNG image of 8-bit gray; depth must be 16-bit gray");
  write_rgb(file, 8, 4, bytes);
  CHECK(error_of(file) == prefix + "is a PNG image of 8-bit colour; depth must be 16-bit gray");
  write_jpeg(file, 8, 4, bytes);
  CHECK(error_of(file) == prefix + "is no PNG image");
  write_bytes(file, "");
  CHECK(error_of(file) == prefix + "is empty");
  write_bytes(file, "\x89PN");
  CHECK(error_of(file) == prefix + "is a broken PNG image: the file is cut short");
  CHECK(error_of(folder / "none.png") ==
        (folder / "none.png").string() + " (frame 7): cannot be opened: No such file or directory");
  CHECK(error_of(folder.path()) == folder.path().string() + " (frame 7): cannot be read: Is a directory");
}

TEST_CASE("a PNG cut anywhere is cut short, never half an image") {
  const TempFolder folder;
  write_gray16(folder / "whole.png", 31, 17, some_depths(31 * 17));
  const std::string whole = file_bytes(folder / "whole.png");
  const auto file = folder / "cut.png";
  for (std::size_t size = 1; size < whole.size(); ++size) {
    write_bytes(file, whole.substr(0, size));
    INFO("cut to " << size << " of " << whole.size() << " bytes");
    CHECK(error_of(file) == file.string() + " (frame 7): is a broken PNG image: the file is cut short");
  }
}

TEST_CASE("a PNG with a wrong bit in its pixels is broken") {
  const TempFolder folder;
  write_gray16(folder / "whole.png", 31, 17, some_depths(31 * 17));
  std::string bytes = file_bytes(folder / "whole.png");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  write_bytes(folder / "bit.png", bytes);
  CHECK_THAT(error_of(folder / "bit.png"),
             Catch::StartsWith((folder / "bit.png").string() + " (frame 7): is a broken PNG image: "));
}

TEST_CASE("a PNG header that asks for too much memory is refused") {
  const TempFolder folder;
  write_gray16(folder / "a.png", 4, 4, some_depths(16));
  std::string bytes = file_bytes(folder / "a.png");
  bytes[16] = 0x7f;  // the width's first byte
  write_bytes(folder / "a.png", bytes);
  CHECK_THAT(error_of(folder / "a.png"), Catch::Contains("is a broken PNG image: "));
}

TEST_CASE("colour images come from PNG and from JPEG") {
  const TempFolder folder;
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < 16 * 8; ++i) rgb.insert(rgb.end(), {200, 100, 50});
  write_rgb(folder / "a.png", 16, 8, rgb);
  CHECK(read_rgb_image(folder / "a.png", 0).pixels == rgb);

  write_jpeg(folder / "a.jpg", 16, 8, rgb);
  const RgbImage jpeg = read_rgb_image(folder / "a.jpg", 0);
  REQUIRE(jpeg.pixels.size() == rgb.size());
  CHECK(jpeg.cols == 16);
  for (std::size_t i = 0; i < rgb.size(); ++i) CHECK(std::abs(jpeg.pixels[i] - rgb[i]) <= 3);

  write_png(folder / "gray.png", 16, 8, PNG_FORMAT_GRAY, std::vector<std::uint8_t>(16 * 8, 77).data());
  CHECK(read_rgb_image(folder / "gray.png", 0).pixels == std::vector<std::uint8_t>(16 * 8 * 3, 77));
}

TEST_CASE("broken colour images are refused with the reason") {
  const TempFolder folder;
  write_jpeg(folder / "a.jpg", 64, 64, std::vector<std::uint8_t>(64 * 64 * 3, 120));
  const std::string whole = file_bytes(folder / "a.jpg");
  const auto cut = folder / "cut.jpg";
  for (std::size_t size = 2; size < whole.size(); size += 7) {
    write_bytes(cut, whole.substr(0, size));
    INFO("cut to " << size << " of " << whole.size() << " bytes");
    CHECK_THAT(rgb_error_of(cut), Catch::StartsWith(cut.string() + " (frame 7): is a broken JPEG image: "));
  }
  write_bytes(cut, "GIF89a");
  CHECK(rgb_error_of(cut) == cut.string() + " (frame 7): is neither a JPEG nor a PNG image");
}
