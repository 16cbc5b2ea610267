#include "modules/maps/picture/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

constexpr double kNear = 0.02;  // m; nothing nearer is drawn

Camera finer(const Camera& camera, int samples) {
  // Sample k of n lies at (k + 0.5) / n - 0.5 from its pixel's centre.
  auto shifted = [&](double c) { return (c + 0.5) * samples - 0.5; };
  return {camera.cols * samples, camera.rows * samples, camera.fx * samples,
          camera.fy * samples,   shifted(camera.cx),    shifted(camera.cy)};
}

double edge(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double x, double y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

/// First and last integer in [low, high] that lie in [0, n).
std::pair<int, int> span_of(double low, double high, int n) {
  return {static_cast<int>(std::ceil(std::clamp(low, 0.0, static_cast<double>(n)))),
          static_cast<int>(std::floor(std::clamp(high, -1.0, n - 1.0)))};
}

}  // namespace

Canvas::Canvas(const Camera& camera, const Pose& T_map_camera, int samples)
    : samples_(samples), fine_(finer(camera, samples)), T_camera_map_(T_map_camera.inverse()) {
  PPM_CHECK(camera.cols > 0 && camera.rows > 0 && samples > 0, "{} x {} pixels, {} samples", camera.cols, camera.rows,
            samples);
  const auto n = static_cast<std::size_t>(fine_.pixels());
  depth_.assign(n, kNothing);
  color_.assign(3 * n, 0.0f);
  coverage_.assign(n, 0.0f);
  stroke_.assign(n, 0);
}

float Canvas::depth(int x, int y) const {
  return depth_[at(x * samples_ + samples_ / 2, y * samples_ + samples_ / 2)];
}

void Canvas::triangle(const std::array<ColoredPoint, 3>& corners) {
  std::array<Corner, 3> in;
  for (std::size_t k = 0; k < 3; ++k) in[k] = {T_camera_map_ * corners[k].position.cast<double>(), corners[k].color};
  if ((in[1].p - in[0].p).cross(in[2].p - in[0].p).dot(in[0].p) >= 0) return;
  // Clip at the near plane: what stays is a triangle or a quadrangle.
  std::array<Corner, 4> out;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner &a = in[k], &b = in[(k + 1) % 3];
    if (a.p.z() >= kNear) out[count++] = a;
    if ((a.p.z() >= kNear) == (b.p.z() >= kNear)) continue;
    const double t = (kNear - a.p.z()) / (b.p.z() - a.p.z());
    out[count++] = {a.p + t * (b.p - a.p), a.color + static_cast<float>(t) * (b.color - a.color)};
  }
  for (std::size_t k = 2; k < count; ++k) fill(out[0], out[k - 1], out[k]);
}

void Canvas::fill(const Corner& a, const Corner& b, const Corner& c) {
  const Eigen::Vector2d pa = fine_.project(a.p), pb = fine_.project(b.p), pc = fine_.project(c.p);
  const double area = edge(pa, pb, pc.x(), pc.y());
  if (area == 0 || !std::isfinite(area)) return;
  const auto [x0, x1] = span_of(std::min({pa.x(), pb.x(), pc.x()}), std::max({pa.x(), pb.x(), pc.x()}), fine_.cols);
  const auto [y0, y1] = span_of(std::min({pa.y(), pb.y(), pc.y()}), std::max({pa.y(), pb.y(), pc.y()}), fine_.rows);
  const double ia = 1 / a.p.z(), ib = 1 / b.p.z(), ic = 1 / c.p.z();
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double wa = edge(pb, pc, x, y) / area, wb = edge(pc, pa, x, y) / area, wc = 1 - wa - wb;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const double inverse_z = wa * ia + wb * ib + wc * ic;
      const auto z = static_cast<float>(1 / inverse_z);
      const auto i = at(x, y);
      if (z >= depth_[i]) continue;
      depth_[i] = z;
      coverage_[i] = 1;
      const auto ta = static_cast<float>(wa * ia / inverse_z), tb = static_cast<float>(wb * ib / inverse_z);
      const Color color = ta * a.color + tb * b.color + (1 - ta - tb) * c.color;
      std::copy_n(color.data(), 3, color_.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
}

void Canvas::shade_depth_edges(float strength) {
  const int reach = samples_;  // one pixel
  const std::array<std::array<int, 2>, 8> around{{{reach, 0},
                                                  {-reach, 0},
                                                  {0, reach},
                                                  {0, -reach},
                                                  {2 * reach, 2 * reach},
                                                  {-2 * reach, 2 * reach},
                                                  {2 * reach, -2 * reach},
                                                  {-2 * reach, -2 * reach}}};
  for (int y = 0; y < fine_.rows; ++y)
    for (int x = 0; x < fine_.cols; ++x) {
      const float z = depth_[at(x, y)];
      if (z == kNothing) continue;
      float behind = 0;
      for (const auto& [dx, dy] : around) {
        const int u = std::clamp(x + dx, 0, fine_.cols - 1), v = std::clamp(y + dy, 0, fine_.rows - 1);
        const float near = depth_[at(u, v)];
        if (near < z) behind += std::min(std::log(z / near), 0.02f);
      }
      const float light = std::exp(-strength * behind);
      for (std::size_t k = 0; k < 3; ++k) color_[3 * at(x, y) + k] *= light;
    }
}

void Canvas::polylines(const std::vector<std::vector<Eigen::Vector3d>>& lines, const Pen& pen) {
  ++strokes_;
  for (const auto& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i) segment(T_camera_map_ * line[i - 1], T_camera_map_ * line[i], pen);
}

void Canvas::segment(Eigen::Vector3d p, Eigen::Vector3d q, const Pen& pen) {
  if (p.z() > q.z()) std::swap(p, q);
  if (q.z() < kNear) return;
  if (p.z() < kNear) p += (kNear - p.z()) / (q.z() - p.z()) * (q - p);
  const Eigen::Vector2d a = fine_.project(p), b = fine_.project(q), ab = b - a;
  const double radius = 0.5 * pen.width_px * samples_;
  const auto [x0, x1] = span_of(std::min(a.x(), b.x()) - radius, std::max(a.x(), b.x()) + radius, fine_.cols);
  const auto [y0, y1] = span_of(std::min(a.y(), b.y()) - radius, std::max(a.y(), b.y()) + radius, fine_.rows);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const Eigen::Vector2d at_px(x, y);
      const double t = ab.squaredNorm() > 0 ? std::clamp((at_px - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0) : 0.0;
      const auto i = at(x, y);
      if ((a + t * ab - at_px).squaredNorm() > radius * radius || stroke_[i] == strokes_) continue;
      stroke_[i] = strokes_;
      const double z = (1 - pen.lift) / ((1 - t) / p.z() + t / q.z());
      const float alpha = z <= depth_[i] ? pen.opacity : pen.opacity_hidden;
      const float under = coverage_[i] * (1 - alpha);  // what is below keeps its share, the background its own
      coverage_[i] = alpha + under;
      if (coverage_[i] <= 0) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        float& c = color_[3 * i + k];
        c = (alpha * pen.color[static_cast<Eigen::Index>(k)] + under * c) / coverage_[i];
      }
    }
}

RgbImage Canvas::resolve(const Color& top, const Color& bottom) const {
  RgbImage image{fine_.cols / samples_, fine_.rows / samples_, {}};
  image.rgb.reserve(3 * static_cast<std::size_t>(image.cols) * static_cast<std::size_t>(image.rows));
  const auto share = 1.0f / static_cast<float>(samples_ * samples_);
  for (int y = 0; y < image.rows; ++y) {
    const Color background = top + (static_cast<float>(y) + 0.5f) / static_cast<float>(image.rows) * (bottom - top);
    for (int x = 0; x < image.cols; ++x) {
      Color sum = Color::Zero();
      for (int v = y * samples_; v < (y + 1) * samples_; ++v)
        for (int u = x * samples_; u < (x + 1) * samples_; ++u) {
          const auto i = at(u, v);
          sum += coverage_[i] * Eigen::Map<const Color>(&color_[3 * i]) + (1 - coverage_[i]) * background;
        }
      for (Eigen::Index k = 0; k < 3; ++k)
        image.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(sum[k] * share, 0.0f, 1.0f))));
    }
  }
  return image;
}

}  // namespace ppm
