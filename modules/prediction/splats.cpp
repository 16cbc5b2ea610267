#include "modules/prediction/splats.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ppm {

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kNear_m = 0.05f;        // nothing nearer is drawn
constexpr float kGrazing = 0.02f;       // cosine: discs that are seen more edge-on have no width
constexpr float kRim = 0.05f;           // weight of a disc at its rim, of 1 in its middle

/// The planes through the camera's centre and the edges of some rows, camera frame, normals inwards.
std::array<Eigen::Vector3f, 4> frustum(const Camera& camera, const Rows& rows) {
  const auto inwards = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& inside) {
    const Eigen::Vector3d n = a.cross(b).normalized();
    return Eigen::Vector3f((n.dot(inside) < 0 ? Eigen::Vector3d(-n) : n).cast<float>());
  };
  const double left = -0.5, right = camera.cols - 0.5, top = rows.first - 0.5, bottom = rows.end - 0.5;
  const Eigen::Vector3d middle = camera.ray((left + right) / 2, (top + bottom) / 2);
  const Eigen::Vector3d a = camera.ray(left, top), b = camera.ray(right, top), c = camera.ray(right, bottom), d = camera.ray(left, bottom);
  return {inwards(a, b, middle), inwards(b, c, middle), inwards(c, d, middle), inwards(d, a, middle)};
}

/// Columns or rows that an interval of x / z times f plus c covers, clipped to [first, end).
struct Span {
  int first, end;
};
Span span(float low, float high, double f, double c, int first, int end) {
  const auto a = static_cast<float>(f) * low + static_cast<float>(c), b = static_cast<float>(f) * high + static_cast<float>(c);
  const float least = std::clamp(std::ceil(std::min(a, b)), static_cast<float>(first), static_cast<float>(end));
  const float most = std::clamp(std::floor(std::max(a, b)) + 1, static_cast<float>(first), static_cast<float>(end));
  return {static_cast<int>(least), static_cast<int>(most)};
}

}  // namespace

void SplatDrawing::draw(const PointMap& map, const SplatSettings& settings, const Rows& rows, Prediction& out) {
  gather(map, rows, out);
  aim(rows, out.camera);
  const auto pixels = static_cast<std::size_t>(rows.end - rows.first) * static_cast<std::size_t>(out.camera.cols);
  nearest_.assign(pixels, kFar);
  foremost_.assign(pixels, 0);
  fragments_.clear();
  for (std::uint32_t k = 0; k < discs_.size(); ++k) rasterize(k, rows, out.camera);
  sums_.assign(pixels, {});
  blend(settings);
  write(rows, out);
}

void SplatDrawing::gather(const PointMap& map, const Rows& rows, const Prediction& out) {
  discs_.clear();
  const auto planes = frustum(out.camera, rows);
  const Eigen::Matrix3f R = out.T_map_camera.linear().transpose().cast<float>();
  const Eigen::Vector3d centre = out.T_map_camera.translation();
  const auto outside = [&](const Eigen::Vector3f& middle, float radius) {
    if (middle.z() < kNear_m - radius) return true;
    return std::ranges::any_of(planes, [&](const auto& n) { return n.dot(middle) < -radius; });
  };
  for (std::uint32_t tile = 0; tile < map.table().size(); ++tile) {
    const PointTile& content = *map.table()[tile].tile;
    if (content.points.empty()) continue;
    const Eigen::Vector3f middle = R * (content.box.center().cast<double>() - centre).cast<float>();
    if (outside(middle, 0.5f * content.box.diagonal().norm())) continue;
    for (std::uint32_t index = 0; index < content.points.size(); ++index) {
      const SurfacePoint& point = content.points[index];
      Disc disc{R * (point.position.cast<double>() - centre).cast<float>(), {}, point.radius_m(), 0, tile, index};
      if (outside(disc.middle, disc.radius)) continue;
      disc.normal = R * point.normal.vector();
      const float facing = disc.normal.dot(disc.middle);
      if (std::abs(facing) < kGrazing * disc.middle.norm()) continue;
      if (facing > 0) disc.normal = -disc.normal;
      disc.variance = point.variance();
      discs_.push_back(disc);
    }
  }
}

void SplatDrawing::aim(const Rows& rows, const Camera& camera) {
  ray_x_.clear();
  ray_y_.clear();
  for (int x = 0; x < camera.cols; ++x) ray_x_.push_back(static_cast<float>(camera.ray(x, 0).x()));
  for (int y = rows.first; y < rows.end; ++y) ray_y_.push_back(static_cast<float>(camera.ray(0, y).y()));
}

void SplatDrawing::rasterize(std::uint32_t number, const Rows& rows, const Camera& camera) {
  const Disc& disc = discs_[number];
  // The box around the disc: it reaches least along its normal.
  const Eigen::Vector3f reach = disc.radius * (Eigen::Vector3f::Ones() - disc.normal.cwiseAbs2()).cwiseMax(0.0f).cwiseSqrt();
  const float near = std::max(disc.middle.z() - reach.z(), kNear_m), far = std::max(disc.middle.z() + reach.z(), kNear_m);
  const auto low = [&](int axis) {
    const float v = disc.middle[axis] - reach[axis];
    return v / (v < 0 ? near : far);
  };
  const auto high = [&](int axis) {
    const float v = disc.middle[axis] + reach[axis];
    return v / (v < 0 ? far : near);
  };
  const Span columns = span(low(0), high(0), camera.fx, camera.cx, 0, camera.cols);
  const Span lines = span(low(1), high(1), camera.fy, camera.cy, rows.first, rows.end);
  const float offset = disc.normal.dot(disc.middle), square = disc.radius * disc.radius;
  for (int y = lines.first; y < lines.end; ++y) {
    const float ray_y = ray_y_[static_cast<std::size_t>(y - rows.first)];
    const float slope = disc.normal.y() * ray_y + disc.normal.z();
    for (int x = columns.first; x < columns.end; ++x) {
      const float ray_x = ray_x_[static_cast<std::size_t>(x)];
      const float depth = offset / (disc.normal.x() * ray_x + slope);
      if (!(depth > kNear_m)) continue;
      const float off = (depth * Eigen::Vector3f(ray_x, ray_y, 1) - disc.middle).squaredNorm();
      if (off > square) continue;
      const auto pixel = static_cast<std::uint32_t>((y - rows.first) * camera.cols + x);
      fragments_.push_back({pixel, number, depth, std::max(1 - off / square, kRim)});
      if (depth < nearest_[pixel]) {
        nearest_[pixel] = depth;
        foremost_[pixel] = number;
      }
    }
  }
}

void SplatDrawing::blend(const SplatSettings& settings) {
  for (const auto& fragment : fragments_) {
    const Disc &disc = discs_[fragment.disc], &front = discs_[foremost_[fragment.pixel]];
    const float behind = fragment.depth - nearest_[fragment.pixel];
    if (behind > std::max(settings.blend_m, settings.blend_sigmas * std::sqrt(front.variance))) continue;
    if (disc.normal.dot(front.normal) < 0.5f) continue;  // another surface: the other side of an edge
    Sum& sum = sums_[fragment.pixel];
    const float weight = fragment.weight / disc.variance;
    sum.weight += weight;
    sum.depth += weight * fragment.depth;
    sum.variance += weight * disc.variance;
    sum.normal += weight * disc.normal;
    if (fragment.weight > sum.middle) {
      sum.middle = fragment.weight;
      sum.disc = fragment.disc;
    }
  }
}

void SplatDrawing::write(const Rows& rows, Prediction& out) const {
  const Eigen::Matrix3f R = out.T_map_camera.linear().cast<float>();
  std::size_t k = 0;
  for (int y = rows.first; y < rows.end; ++y) {
    for (int x = 0; x < out.camera.cols; ++x, ++k) {
      const Sum& sum = sums_[k];
      if (!(sum.weight > 0)) continue;
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(out.camera.cols) + static_cast<std::size_t>(x);
      const Eigen::Vector3f normal = R * sum.normal.normalized();
      out.range[pixel] = sum.depth / sum.weight * static_cast<float>(out.camera.ray(x, y).norm());
      out.variance[pixel] = sum.variance / sum.weight;
      for (int axis = 0; axis < 3; ++axis) out.normal[3 * pixel + static_cast<std::size_t>(axis)] = normal[axis];
      out.chunk[pixel] = discs_[sum.disc].tile;
      out.face[pixel] = discs_[sum.disc].index;
    }
  }
}

}  // namespace ppm
