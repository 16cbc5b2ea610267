#include "framework/slam/surface_patches.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <optional>

namespace ppm {
namespace {

constexpr double kLeastShare = 0.8;      // of the pixels of a patch, with a return
constexpr double kSurfaceSigma_m = 0.002;  // of a plane as an image of a surface
constexpr double kMostRms = 1.5;         // of depths from the plane, in standard deviations
constexpr double kLeastCosine = 0.4226;  // 65 degrees

/// Least squares of disparity over a square of pixels.
class PlaneFit {
 public:
  void add(double dx, double dy, double disparity, double weight) {
    const Eigen::Vector3d a(1, dx, dy);
    A_ += weight * a * a.transpose();
    b_ += weight * disparity * a;
    square_ += weight * disparity * disparity;
    ++count_;
  }
  int count() const { return count_; }
  Eigen::Vector3d solve() const { return A_.ldlt().solve(b_); }
  /// Mean over the pixels of the squared residual of what solve() gave, times weight.
  double mean_square(const Eigen::Vector3d& plane) const { return (square_ - b_.dot(plane)) / count_; }

 private:
  Eigen::Matrix3d A_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b_ = Eigen::Vector3d::Zero();
  double square_ = 0;
  int count_ = 0;
};

std::optional<SurfacePatch> patch_at(const Frame& frame, int x, int y, int reach) {
  const Camera& camera = frame.camera;
  if (x < reach || y < reach || x + reach >= camera.cols || y + reach >= camera.rows) return std::nullopt;
  if (!frame.valid(y * camera.cols + x)) return std::nullopt;
  const auto centre = static_cast<std::size_t>(y * camera.cols + x);
  const double middle = 1.0 / frame.depth[centre];
  PlaneFit fit;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      const int pixel = (y + dy) * camera.cols + x + dx;
      if (!frame.valid(pixel)) continue;
      const double z = frame.depth[static_cast<std::size_t>(pixel)], sigma = frame.sigma[static_cast<std::size_t>(pixel)];
      fit.add(dx, dy, 1 / z - middle, std::pow(z * z / sigma, 2));
    }
  const int side = 2 * reach + 1;
  if (fit.count() < kLeastShare * side * side) return std::nullopt;
  const Eigen::Vector3d plane = fit.solve();
  const SurfacePatch patch{static_cast<double>(x), static_cast<double>(y), plane[0] + middle, plane[1], plane[2],
                           std::hypot(frame.sigma[centre], kSurfaceSigma_m)};
  if (fit.mean_square(plane) > kMostRms * kMostRms || !(patch.disparity > 0)) return std::nullopt;
  const PlacedPatch seen = placed(patch, camera, {});
  const double cosine = seen.plane.dot(seen.point) / (seen.plane.norm() * seen.point.norm());
  return cosine > kLeastCosine ? std::optional(patch) : std::nullopt;
}

}  // namespace

int SurfacePatches::around(double x, double y) const {
  const int first = step / 2;
  const double col = std::floor((x - first) / step + 0.5), row = std::floor((y - first) / step + 0.5);
  if (!(col >= 0 && row >= 0 && col < cols && row < rows)) return -1;
  return at[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(col)];
}

SurfacePatches surface_patches(const Frame& frame, int step) {
  SurfacePatches out;
  out.camera = frame.camera;
  out.step = step;
  for (int y = step / 2; y < frame.camera.rows; y += step, ++out.rows) {
    out.cols = 0;
    for (int x = step / 2; x < frame.camera.cols; x += step, ++out.cols) {
      const auto patch = patch_at(frame, x, y, step);
      out.at.push_back(patch ? static_cast<int>(out.all.size()) : -1);
      if (patch) out.all.push_back(*patch);
    }
  }
  return out;
}

PlacedPatch placed(const SurfacePatch& patch, const Camera& camera, const CameraCorrection& correction) {
  const Camera c = correction.camera(camera);
  auto point = [&](double dx, double dy) -> Eigen::Vector3d {
    const double z = 1 / (patch.disparity + dx * patch.slope_x + dy * patch.slope_y);
    const Eigen::Vector3d ray = c.ray(patch.x + dx, patch.y + dy);
    return correction.depth(z, correction.bend(ray)) * ray;
  };
  PlacedPatch out;
  out.point = point(0, 0);
  const Eigen::Vector3d normal = (point(1, 0) - point(-1, 0)).cross(point(0, 1) - point(0, -1));
  out.plane = normal / normal.dot(out.point);
  out.sigma = correction.depth_slope(1 / patch.disparity, correction.bend(c.ray(patch.x, patch.y))) * patch.sigma;
  return out;
}

}  // namespace ppm
