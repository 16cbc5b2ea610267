#include <catch2/catch.hpp>
#include <fstream>
#include <png.h>
#include <set>

#include "framework/graph/harness.hpp"
#include "modules/builtin.hpp"
#include "tests/support/ppm_maps.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;

namespace {

struct Picture {
  int cols = 0, rows = 0;
  std::vector<std::uint8_t> rgb;
};

Picture read_png(const std::filesystem::path& file) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_file(&header, file.c_str()) != 0);
  header.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  picture.rgb.resize(PNG_IMAGE_SIZE(header));
  REQUIRE(png_image_finish_read(&header, nullptr, picture.rgb.data(), 0, nullptr) != 0);
  return picture;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("sink.image draws map and paths, in each of its colours, the same each time") {
  test::TempFolder dir;
  Registry registry;
  register_builtin(registry);
  const auto map =
      test::height_field(20, 15, 0.1f, {}, [](float x, float y) { return 0.3f * std::sin(3 * x) * std::sin(3 * y); });
  std::set<std::string> different;
  for (const std::string color : {"shaded", "sigma", "mean", "normal"}) {
    for (const std::string name : {"a.png", "b.png"}) {
      Harness h(registry, "sink.image", "{cols: 160, rows: 120, up: z, show: " + color + ", file: " + name + "}", 1, 1,
                dir.path());
      h.belief().init(3, Pose::Identity(), map);
      for (std::size_t i = 0; i < 3; ++i)
        for (int t = 0; t < 10; ++t)
          h.belief().extend(i,
                            {t, 0.1 * t, Pose(Eigen::Translation3d(0.2 * t, 1 + 0.01 * static_cast<double>(i), 1.5))});
      h.tick();
    }
    const auto picture = read_png(dir / "a.png");
    CHECK(picture.cols == 160);
    CHECK(picture.rows == 120);
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) drawn += picture.rgb[i] < 225 || picture.rgb[i + 2] < 225;
    CHECK(drawn > 160 * 120 / 6);
    CHECK(bytes_of(dir / "a.png") == bytes_of(dir / "b.png"));
    different.insert(bytes_of(dir / "a.png"));
  }
  CHECK(different.size() == 4);
}

TEST_CASE("sink.image draws an empty map as an empty picture") {
  test::TempFolder dir;
  Registry registry;
  register_builtin(registry);
  Harness h(registry, "sink.image", "{cols: 32, rows: 32}", 1, 1, dir.path());
  h.belief().init(1, Pose::Identity(), std::make_shared<const PpmMap>(PpmSettings{}));
  h.tick();
  CHECK(read_png(dir / "map.png").rgb.size() == 32 * 32 * 3);
}
