#include "modules/maps/picture/mesh_renderer.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

constexpr float kCreaseCos = 0.766f;  // 40 degrees

/// The faces around each vertex: faces of vertex v are item[first[v]] .. item[first[v + 1] - 1].
struct Fans {
  std::vector<std::uint32_t> first, item;
};

Fans fans_of(const Mesh& mesh) {
  Fans fans;
  fans.first.assign(mesh.position.size() + 1, 0);
  for (const auto& face : mesh.face)
    for (auto v : face) ++fans.first[v + 1];
  for (std::size_t v = 0; v < mesh.position.size(); ++v) fans.first[v + 1] += fans.first[v];
  fans.item.resize(3 * mesh.face.size());
  auto next = fans.first;
  for (std::uint32_t f = 0; f < mesh.face.size(); ++f)
    for (auto v : mesh.face[f]) fans.item[next[v]++] = f;
  return fans;
}

/// Area-weighted normals, not normalised.
std::vector<Eigen::Vector3f> face_normals(const Mesh& mesh) {
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(mesh.face.size());
  for (const auto& [a, b, c] : mesh.face)
    normals.push_back((mesh.position[b] - mesh.position[a]).cross(mesh.position[c] - mesh.position[a]));
  return normals;
}

/// Normal at a face's corner: of the faces around the vertex that continue this one smoothly.
Eigen::Vector3f corner_normal(const Fans& fans, const std::vector<Eigen::Vector3f>& normals, std::uint32_t face,
                              std::uint32_t vertex) {
  const Eigen::Vector3f own = normals[face].normalized();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (auto i = fans.first[vertex]; i < fans.first[vertex + 1]; ++i) {
    const auto& n = normals[fans.item[i]];
    if (n.dot(own) >= kCreaseCos * n.norm()) sum += n;
  }
  return sum.normalized();
}

/// Piecewise linear colour map over [0, 1].
template <std::size_t N>
Color ramp(const std::array<std::array<float, 3>, N>& stops, float t) {
  const float x = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(N - 1);
  const auto i = std::min(static_cast<std::size_t>(x), N - 2);
  const float w = x - static_cast<float>(i);
  return (1 - w) * Eigen::Map<const Color>(stops[i].data()) + w * Eigen::Map<const Color>(stops[i + 1].data());
}

Color height_color(float t) {
  static constexpr std::array<std::array<float, 3>, 5> kStops{{{0.62f, 0.50f, 0.40f},
                                                               {0.80f, 0.69f, 0.54f},
                                                               {0.86f, 0.83f, 0.74f},
                                                               {0.74f, 0.82f, 0.85f},
                                                               {0.60f, 0.72f, 0.84f}}};
  return ramp(kStops, t);
}

/// A key light over the viewer's left shoulder, a weaker one from the right, and light from above.
class Lights {
 public:
  explicit Lights(const Eigen::Vector3f& up) : up_(up) {
    Eigen::Vector3f side = up.unitOrthogonal();
    key_ = (0.8f * up + 0.55f * side + 0.25f * up.cross(side)).normalized();
    fill_ = (0.3f * up - 0.4f * side - 0.85f * up.cross(side)).normalized();
  }
  float at(const Eigen::Vector3f& n) const {
    return 0.40f + 0.42f * std::max(0.0f, n.dot(key_)) + 0.22f * std::max(0.0f, n.dot(fill_)) + 0.10f * n.dot(up_);
  }

 private:
  Eigen::Vector3f up_, key_, fill_;
};

/// Heights between which the tint runs: all but the lowest and the highest hundredth of the vertices.
std::pair<float, float> height_range(const Mesh& mesh, const Eigen::Vector3f& up) {
  std::vector<float> heights;
  for (const auto& p : mesh.position) heights.push_back(p.dot(up));
  std::sort(heights.begin(), heights.end());
  const auto margin = heights.size() / 100;
  return {heights[margin], std::max(heights[heights.size() - 1 - margin], heights[margin] + 1e-3f)};
}

}  // namespace

void draw_mesh(Canvas& canvas, const Mesh& mesh, Show show, const std::optional<ColorScale>& scale,
               const Eigen::Vector3f& up) {
  if (mesh.face.empty()) return;
  const Fans fans = fans_of(mesh);
  const auto normals = face_normals(mesh);
  const Lights lights(up);
  const auto [low, high] = height_range(mesh, up);
  const auto colors = vertex_colors(mesh, show, scale);
  PPM_CHECK(show == Show::shaded || !colors.empty(), "a mesh without {}", to_string(show));
  auto color_at = [&, low = low, high = high](std::uint32_t v, const Eigen::Vector3f& n) -> Color {
    if (show == Show::normal) return normal_color(n);
    if (show == Show::shaded) return lights.at(n) * height_color((mesh.position[v].dot(up) - low) / (high - low));
    return (0.55f + 0.45f * lights.at(n)) * colors[v];
  };
  for (std::uint32_t f = 0; f < mesh.face.size(); ++f) {
    std::array<ColoredPoint, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = mesh.face[f][k];
      corners[k] = {mesh.position[v], color_at(v, corner_normal(fans, normals, f, v))};
    }
    canvas.triangle(corners);
  }
}

void draw_edges(Canvas& canvas, const Mesh& mesh, double width_px) {
  std::vector<std::vector<Eigen::Vector3d>> lines;
  auto at = [&](std::uint32_t v) -> Eigen::Vector3d { return mesh.position[v].cast<double>(); };
  for (const auto& [a, b, c] : mesh.face) lines.push_back({at(a), at(b), at(c), at(a)});
  canvas.polylines(lines, {{0.1f, 0.1f, 0.12f}, width_px, 0.6f, 0, 0.003});
}

}  // namespace ppm
