#include "modules/rawlog/scan_image.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "modules/rawlog/mrpt_pose.hpp"

namespace ppm {

namespace {

using mrpt::img::DistortionModel;
using mrpt::obs::CObservation3DRangeScan;

Camera camera_of(const CObservation3DRangeScan& scan) {
  const auto& c = scan.cameraParams;
  Camera camera{static_cast<int>(c.ncols), static_cast<int>(c.nrows), c.fx(), c.fy(), c.cx(), c.cy()};
  if (scan.hasRangeImage) {
    camera.cols = static_cast<int>(scan.rangeImage.cols());
    camera.rows = static_cast<int>(scan.rangeImage.rows());
    if (camera.cols != static_cast<int>(c.ncols) || camera.rows != static_cast<int>(c.nrows))
      throw std::runtime_error(fmt::format("the range image has {}x{} pixels, its camera {}x{}", camera.cols,
                                           camera.rows, c.ncols, c.nrows));
  }
  if (camera.pixels() == 0) throw std::runtime_error("the range image is empty");
  if (!std::isfinite(camera.fx * camera.fy * camera.cx * camera.cy) || camera.fx == 0 || camera.fy == 0)
    throw std::runtime_error("the depth camera has no focal length");
  return camera;
}

/// Where a lens of OpenCV's rational model puts a point of the plane z = 1.
Eigen::Vector2d distorted(const std::array<double, 8>& d, double x, double y) {
  const double r2 = x * x + y * y;
  const double radial = (1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]))) / (1 + r2 * (d[5] + r2 * (d[6] + r2 * d[7])));
  return {x * radial + 2 * d[2] * x * y + d[3] * (r2 + 2 * x * x),
          y * radial + d[2] * (r2 + 2 * y * y) + 2 * d[3] * x * y};
}

/// [rows*cols] the scan's pixel that each pixel of the ideal camera is; -1: outside of its image.
std::vector<int> pixels_of(const mrpt::img::TCamera& lens, const Camera& camera) {
  std::vector<int> source(static_cast<std::size_t>(camera.pixels()));
  const bool straight = lens.distortion == DistortionModel::none || lens.dist == std::array<double, 8>{};
  if (!straight && lens.distortion != DistortionModel::plumb_bob)
    throw std::runtime_error("the depth camera is a fisheye, which is not supported");
  for (int y = 0, i = 0; y < camera.rows; ++y)
    for (int x = 0; x < camera.cols; ++x, ++i) {
      source[static_cast<std::size_t>(i)] = i;
      if (straight) continue;
      const Eigen::Vector3d ray = camera.ray(x, y);
      const Eigen::Vector2d p = distorted(lens.dist, ray.x(), ray.y());
      const auto column = std::lround(camera.fx * p.x() + camera.cx), row = std::lround(camera.fy * p.y() + camera.cy);
      const bool inside = column >= 0 && column < camera.cols && row >= 0 && row < camera.rows;
      source[static_cast<std::size_t>(i)] = inside ? static_cast<int>(row * camera.cols + column) : -1;
    }
  return source;
}

/// [rows*cols] m as the scan has them, along the axis or along the ray; 0: nothing.
std::vector<double> ranges_of_image(const CObservation3DRangeScan& scan, const Camera& camera) {
  // Units are written as floats: 0.001f is not quite a millimetre.
  const double per_m = 1 / static_cast<double>(scan.rangeUnits), whole = std::round(per_m);
  const double units_per_m = std::abs(per_m - whole) < 1e-6 * whole ? whole : per_m;
  std::vector<double> ranges;
  ranges.reserve(static_cast<std::size_t>(camera.pixels()));
  for (int y = 0; y < camera.rows; ++y)
    for (int x = 0; x < camera.cols; ++x) ranges.push_back(scan.rangeImage(y, x) / units_per_m);
  return ranges;
}

/// Of the points' places in the image, or of their order where there are as many as pixels. MRPT's x is forward.
std::vector<double> depths_of_points(const CObservation3DRangeScan& scan, const Camera& camera) {
  const auto pixels = static_cast<std::size_t>(camera.pixels()), points = scan.points3D_x.size();
  const bool placed = scan.points3D_idxs_x.size() == points && scan.points3D_idxs_y.size() == points;
  if (!placed && points != pixels)
    throw std::runtime_error(fmt::format("{} points without a place in the image of {} pixels", points, pixels));
  std::vector<double> depths(pixels, 0.0);
  for (std::size_t k = 0; k < points; ++k) {
    const auto at = placed ? scan.points3D_idxs_y[k] * static_cast<std::size_t>(camera.cols) + scan.points3D_idxs_x[k] : k;
    if (at >= pixels || (placed && scan.points3D_idxs_x[k] >= camera.cols))
      throw std::runtime_error(fmt::format("point {} lies outside of the image", k));
    depths[at] = scan.points3D_x[k];
  }
  return depths;
}

bool has_registered_color(const CObservation3DRangeScan& scan) {
  const auto &a = scan.cameraParams, &b = scan.cameraParamsIntensity;
  return scan.hasIntensityImage && scan.doDepthAndIntensityCamerasCoincide() && a.ncols == b.ncols &&
         a.nrows == b.nrows && a.intrinsicParams == b.intrinsicParams && a.dist == b.dist;
}

void add_color(const mrpt::img::CImage& image, const std::vector<int>& source, Frame& frame) {
  if (static_cast<int>(image.getWidth()) != frame.camera.cols || static_cast<int>(image.getHeight()) != frame.camera.rows)
    throw std::runtime_error("the colour image is not of the size of the range image");
  const int channels = image.channelCount();
  for (const int p : source) {
    const auto* pixel = image.ptrLine<std::uint8_t>(static_cast<unsigned>(std::max(p, 0) / frame.camera.cols)) +
                        channels * (std::max(p, 0) % frame.camera.cols);
    const bool colored = channels >= 3;  // blue first
    for (const int c : {2, 1, 0}) frame.color.push_back(p < 0 ? 0 : pixel[colored ? c : 0]);
  }
}

void add_confidence(const mrpt::img::CImage& image, const std::vector<int>& source, Frame& frame) {
  if (static_cast<int>(image.getWidth()) != frame.camera.cols || static_cast<int>(image.getHeight()) != frame.camera.rows)
    throw std::runtime_error("the confidence image is not of the size of the range image");
  for (const int p : source) {
    const auto* line = image.ptrLine<std::uint8_t>(static_cast<unsigned>(std::max(p, 0) / frame.camera.cols));
    frame.confidence.push_back(p < 0 ? 0.0f : line[image.channelCount() * (p % frame.camera.cols)]);
  }
}

}  // namespace

Frame frame_of_scan(const CObservation3DRangeScan& scan, bool with_color) {
  if (!scan.hasRangeImage && !scan.hasPoints3D)
    throw std::runtime_error("the scan has neither a range image nor points");
  Frame frame;
  frame.camera = camera_of(scan);
  frame.T_base_camera = from_mrpt(scan.sensorPose) * T_sensor_camera();
  const auto source = pixels_of(scan.cameraParams, frame.camera);
  const bool points = !scan.hasRangeImage;
  const auto ranges = points ? depths_of_points(scan, frame.camera) : ranges_of_image(scan, frame.camera);
  for (std::size_t i = 0; i < source.size(); ++i) {
    const double range = source[i] < 0 ? 0 : ranges[static_cast<std::size_t>(source[i])];
    const int x = static_cast<int>(i) % frame.camera.cols, y = static_cast<int>(i) / frame.camera.cols;
    const double depth = points || scan.range_is_depth ? range : range / frame.camera.ray(x, y).norm();
    frame.depth.push_back(depth > 0 ? static_cast<float>(depth) : std::numeric_limits<float>::quiet_NaN());
  }
  if (scan.hasConfidenceImage) add_confidence(scan.confidenceImage, source, frame);
  if (!with_color) return frame;
  if (!has_registered_color(scan)) throw std::runtime_error("the scan has no colour image that is registered to depth");
  add_color(scan.intensityImage, source, frame);
  return frame;
}

}  // namespace ppm
