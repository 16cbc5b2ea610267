#include <catch2/catch.hpp>
#include <fmt/core.h>
#include <functional>
#include <zlib.h>

#include "modules/sources/gzip.hpp"
#include "modules/sources/radial_lens.hpp"
#include "tests/sources/image_writer.hpp"
#include "tests/sources/source_reader.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using namespace ppm::test;
using Catch::Matchers::Contains;

namespace {

constexpr int kCols = 44, kRows = 36;
const RadialLens kLens{21.4, 17.6, 60, -40, 20, 0};

/// The ray of a pixel of the lens, by fixed-point iteration.
std::pair<double, double> ray_of(int column, int row) {
  double x = 0, y = 0;
  for (int k = 0; k < 50; ++k) {
    const double r2 = x * x + y * y, scale = kLens.f + r2 * (kLens.a + r2 * kLens.b);
    x = (column - kLens.cx) / scale;
    y = (row - kLens.cy) / scale;
  }
  return {x, y};
}

std::string block(const std::string& title, const std::function<double(int, int)>& value) {
  std::string text = "% " + title + "\n";
  for (int y = 0; y < kRows; ++y, text += '\n')
    for (int x = 0; x < kCols; ++x) text += fmt::format("{:.5f}\t", value(x, y));
  return text;
}

/// A plane z = 2 + 0.1 x seen through the lens; the pixel (5, 6) sends nothing back.
std::string image_text() {
  auto depth = [](int c, int r) { return 2 / (1 - 0.1 * ray_of(c, r).first); };
  auto lit = [](int c, int r) { return c == 5 && r == 6 ? 0.0 : 100.0 + c; };
  return block("Calibrated Distance", depth) +
         block("Calibrated xVector", [&](int c, int r) { return -ray_of(c, r).first * depth(c, r); }) +
         block("Calibrated yVector", [&](int c, int r) { return -ray_of(c, r).second * depth(c, r); }) +
         block("Amplitude", lit) + block("Confidence map", [](int, int) { return 7; }) +
         "% additional data / time stamp [ms]\n3 nan nan\n";
}

std::string zipped(const std::string& text) {
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string out(deflateBound(&stream, text.size()) + 32, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::string params(const TempFolder& folder) {
  return fmt::format("{{path: \"{}\", focal: 55}}", folder.path().string());
}

/// What is wrong with a folder of these files, the second of which is bad.
std::string error(const std::string& text) {
  TempFolder folder;
  write_bytes(folder / "a.dat", image_text());
  write_bytes(folder / "b.dat", text);
  return data_error("source.sr4000", params(folder));
}

}  // namespace

TEST_CASE("gunzip gives back what was packed, and says where that is not whole") {
  std::string text;
  for (int i = 0; i < 20000; ++i) text += std::to_string(i * i % 977);
  const std::string packed = zipped(text);
  CHECK(packed.size() < text.size());
  CHECK(gunzip(packed).bytes == text);
  CHECK(gunzip(packed).error.empty());
  CHECK(gunzip("no gzip").bytes == "no gzip");
  CHECK_FALSE(gunzip(packed.substr(0, packed.size() - 9)).error.empty());
  std::string broken = packed;
  broken[broken.size() / 2] ^= 0x55;
  CHECK_FALSE(gunzip(broken).error.empty());
}

TEST_CASE("the lens is found from the rays of its pixels") {
  PixelRays rays;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kCols; ++column) {
      rays.column.push_back(column);
      rays.row.push_back(row);
      rays.x.push_back(ray_of(column, row).first);
      rays.y.push_back(ray_of(column, row).second);
    }
  const RadialLens lens = fit_radial_lens(rays);
  CHECK(lens.cx == Approx(kLens.cx));
  CHECK(lens.cy == Approx(kLens.cy));
  CHECK(lens.f == Approx(kLens.f));
  CHECK(lens.a == Approx(kLens.a).epsilon(1e-3));
  CHECK(lens.b == Approx(kLens.b).epsilon(1e-2));
  CHECK(lens.rms < 1e-3);
}

TEST_CASE("source.sr4000 gives depth without the lens' distortion, and the amplitude as confidence") {
  TempFolder folder;
  write_bytes(folder / "a.dat", image_text());
  write_bytes(folder / "b.dat.gz", zipped(image_text()));
  write_bytes(folder / "readme.txt", "not an image");
  SourceReader reader("source.sr4000", params(folder));
  for (int i = 0; i < 2; ++i) {
    const auto frame = reader.next();
    REQUIRE(frame);
    CHECK(frame->index == i);
    CHECK(frame->stamp_s == Approx(i / 30.0));
    CHECK(frame->camera == Camera{kCols, kRows, 55, 55, 21.5, 17.5});
    CHECK_FALSE(frame->T_world_camera_ref);
    REQUIRE(frame->confidence.size() == frame->depth.size());
    int without = 0;
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kCols; ++x) {
        const int p = kCols * y + x;
        if (!frame->valid(p)) {
          ++without;
          continue;
        }
        const double ray = frame->camera.ray(x, y).x();  // of the nearest pixel: half a pixel off at most
        CHECK(frame->depth[static_cast<std::size_t>(p)] == Approx(2 / (1 - 0.1 * ray)).margin(0.004));
        CHECK(frame->confidence[static_cast<std::size_t>(p)] ==
              Approx(100 + kLens.column(ray, frame->camera.ray(x, y).y())).margin(0.51));
      }
    CHECK(without >= 1);
    CHECK(without < 60);
  }
  CHECK_FALSE(reader.next());
}

TEST_CASE("broken images of an SR4000 are told by file, frame and line") {
  std::string text = image_text();
  CHECK_THAT(error(text.substr(0, text.find("% Amplitude"))), Contains("b.dat (frame 1): has no block '% Amplitude'"));
  std::string word = text;
  word.replace(word.find("2."), 2, "z.");
  CHECK_THAT(error(word), Contains("line 2") && Contains("not a finite number"));
  std::string shorter = text;
  shorter.erase(shorter.find('\t', 600), 8);
  CHECK_THAT(error(shorter), Contains("rows began with 44"));
  CHECK_THAT(error(text + "% Amplitude\n"), Contains("a second block 'Amplitude'"));
  CHECK_THAT(error("\x1f\x8b damaged"), Contains("cannot be unpacked"));
  CHECK_THAT(error(""), Contains("has no block"));
}

TEST_CASE("a folder without usable images of an SR4000 is refused") {
  TempFolder folder;
  CHECK_THAT(data_error("source.sr4000", params(folder)), Contains("has no images (*.dat or *.dat.gz)"));
  std::string flat = block("Calibrated Distance", [](int, int) { return 0.01; });
  for (const char* title : {"Calibrated xVector", "Calibrated yVector", "Amplitude", "Confidence map"})
    flat += block(title, [](int, int) { return 1; });
  write_bytes(folder / "a.dat", flat);
  CHECK_THAT(data_error("source.sr4000", params(folder)), Contains("too few to find the lens"));
  std::string scattered = block("Calibrated Distance", [](int, int) { return 2; });
  for (const char* title : {"Calibrated xVector", "Calibrated yVector", "Amplitude", "Confidence map"})
    scattered += block(title, [](int c, int r) { return (7 * c + 13 * r) % 5; });
  write_bytes(folder / "a.dat", scattered);
  CHECK_THAT(data_error("source.sr4000", params(folder)), Contains("not those of a lens"));
}

TEST_CASE("the real SR4000: four places, a room's depths") {
  const auto data = data_path("sr4000");
  if (!data) return;
  SourceReader reader("source.sr4000", fmt::format("{{path: \"{}\"}}", data->string()));
  int frames = 0;
  while (const auto frame = reader.next()) {
    ++frames;
    CHECK(frame->camera.cols == 176);
    CHECK(frame->camera.rows == 144);
    int valid = 0;
    for (int p = 0; p < frame->camera.pixels(); ++p) valid += frame->valid(p);
    CHECK(valid > 0.8 * frame->camera.pixels());
  }
  CHECK(frames == 16);
}
