#include "modules/sources/sr4000_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/core/error.hpp"
#include "modules/sources/data_path.hpp"
#include "modules/sources/radial_lens.hpp"

namespace ppm {
namespace {

constexpr float kLeastDepth = 0.3f;  // m; nearer points are noise, and their rays rounded
constexpr double kMostRms = 0.5;     // px; worse is no lens
constexpr std::size_t kLeastRays = 1000;

bool is_image(const std::string& name) {
  return name.ends_with(".dat") || name.ends_with(".dat.gz");
}

PixelRays rays_of(const Sr4000Image& image) {
  PixelRays rays;
  for (int y = 0, i = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x, ++i) {
      const auto p = static_cast<std::size_t>(i);
      if (!(image.z[p] > kLeastDepth)) continue;
      rays.column.push_back(x);
      rays.row.push_back(y);
      rays.x.push_back(-image.x[p] / image.z[p]);
      rays.y.push_back(-image.y[p] / image.z[p]);
    }
  return rays;
}

}  // namespace

Sr4000Sequence::Sr4000Sequence(const Sr4000Settings& settings)
    : settings_(settings), folder_(data_folder(settings.path)) {
  list_files();
  find_lens();
}

void Sr4000Sequence::list_files() {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error))
    if (is_image(entry.path().filename().string())) files_.push_back(entry.path());
  if (error) throw DataError(folder_.string(), "cannot be listed: " + error.message());
  if (files_.empty()) throw DataError(folder_.string(), "has no images (*.dat or *.dat.gz)");
  std::sort(files_.begin(), files_.end());
}

void Sr4000Sequence::find_lens() {
  const std::string file = files_.front().string();
  const Sr4000Image image = read_sr4000(files_.front(), 0);
  const PixelRays rays = rays_of(image);
  if (rays.x.size() < kLeastRays)
    throw DataError(
        file, 0,
        fmt::format("only {} points are farther than {} m: too few to find the lens from", rays.x.size(), kLeastDepth));
  const RadialLens lens = fit_radial_lens(rays);
  if (!(lens.rms < kMostRms))
    throw DataError(file, 0,
                    fmt::format("its points are not those of a lens: they miss their pixels by {:.2g}", lens.rms));
  camera_ = {
      image.cols, image.rows, settings_.focal_px, settings_.focal_px, 0.5 * (image.cols - 1), 0.5 * (image.rows - 1)};
  source_.reserve(static_cast<std::size_t>(camera_.pixels()));
  for (int y = 0; y < camera_.rows; ++y)
    for (int x = 0; x < camera_.cols; ++x) {
      const Eigen::Vector3d ray = camera_.ray(x, y);
      const auto column = std::lround(lens.column(ray.x(), ray.y())), row = std::lround(lens.row(ray.x(), ray.y()));
      const bool inside = column >= 0 && column < image.cols && row >= 0 && row < image.rows;
      source_.push_back(inside ? static_cast<int>(row * image.cols + column) : -1);
    }
}

Frame Sr4000Sequence::read(std::int64_t index) const {
  const auto& file = files_[static_cast<std::size_t>(index)];
  const Sr4000Image image = read_sr4000(file, index);
  if (image.cols != camera_.cols || image.rows != camera_.rows)
    throw DataError(file.string(), index,
                    fmt::format("is {}x{} pixels; the sequence began with {}x{}", image.cols, image.rows, camera_.cols,
                                camera_.rows));
  Frame frame;
  frame.index = index;
  frame.stamp_s = stamp_s(index);
  frame.camera = camera_;
  for (const int p : source_) {
    const bool seen = p >= 0 && image.amplitude[static_cast<std::size_t>(p)] > 0;
    frame.depth.push_back(seen ? image.z[static_cast<std::size_t>(p)] : std::numeric_limits<float>::quiet_NaN());
    frame.confidence.push_back(seen ? image.amplitude[static_cast<std::size_t>(p)] : 0.0f);
  }
  return frame;
}

}  // namespace ppm
