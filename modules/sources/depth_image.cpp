#include "modules/sources/depth_image.hpp"

#include <limits>

#include "framework/core/error.hpp"
#include "modules/sources/image_file.hpp"

namespace ppm {

void set_image_size(const std::filesystem::path& file, std::int64_t index, Camera& camera) {
  const GrayImage16 image = read_gray16_png(file, index);
  camera.cols = image.cols;
  camera.rows = image.rows;
}

void read_depth_image(const std::filesystem::path& file, double units_per_m, Frame& frame) {
  const GrayImage16 image = read_gray16_png(file, frame.index);
  if (image.cols != frame.camera.cols || image.rows != frame.camera.rows)
    throw DataError(file.string(), frame.index,
                    fmt::format("is {}x{} pixels; the sequence began with {}x{}", image.cols, image.rows,
                                frame.camera.cols, frame.camera.rows));
  frame.depth.resize(image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const std::uint16_t units = image.pixels[i];
    const bool valid = units != 0 && units != 65535;
    frame.depth[i] = valid ? static_cast<float>(units / units_per_m) : std::numeric_limits<float>::quiet_NaN();
  }
}

void read_color_image(const std::filesystem::path& file, Frame& frame) {
  RgbImage image = read_rgb_image(file, frame.index);
  if (image.cols != frame.camera.cols || image.rows != frame.camera.rows)
    throw DataError(file.string(), frame.index,
                    fmt::format("is {}x{} pixels; its depth image is {}x{}", image.cols, image.rows, frame.camera.cols,
                                frame.camera.rows));
  frame.color = std::move(image.pixels);
}

}  // namespace ppm
