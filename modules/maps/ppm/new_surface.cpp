#include "modules/maps/ppm/new_surface.hpp"

#include <algorithm>
#include <cmath>

#include "modules/maps/ppm/triangulation.hpp"

namespace ppm {
namespace {

/// A vertex of the triangulation.
struct Node {
  Eigen::Vector2f pixel;
  Eigen::Vector3f point, normal;           // relative to the view's centre
  std::uint32_t number = RimVertex::kNew;  // in the boundary; kNew for a leaf corner that no face uses yet
};

class SurfaceMaker {
 public:
  SurfaceMaker(const UpdateView& view, const std::vector<std::uint8_t>& classes,
               const std::vector<std::uint8_t>& wanted, const NewSurfaceSettings& settings, Boundary& boundary)
      : view_(view), classes_(classes), wanted_(wanted), settings_(settings), boundary_(boundary) {}

  void run(std::vector<RimFace>& faces) {
    near_ = wanted_;
    dilate_mask(view_.cols(), view_.rows(), settings_.leaves.leaf_max, near_);
    find_corners();
    if (corners_.empty() && nodes_.empty()) return;
    take_rim();
    drop_corners_at_edges();
    for (const auto& c : corners_)
      if (kept_[view_.at(c.x, c.y)] != kNone) take_corner(c);
    triangulate(faces);
  }

 private:
  static constexpr int kNone = -1;

  void find_corners() {
    DisparityImage image;
    image.build(view_, near_, settings_.smooth_radius, settings_.smooth_sigmas);
    corners_ = leaf_corners(image, disparity_leaves(image, wanted_, settings_.leaves), settings_.corner_sigmas);
    kept_.assign(wanted_.size(), kNone);
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const auto p = view_.at(corners_[i].x, corners_[i].y);
      if (!(classes_[p] & kOwnHit)) kept_[p] = static_cast<int>(i);
    }
  }

  /// Boundary vertices that this image shows near wanted pixels become nodes, and clear the corners around them.
  void take_rim() {
    node_of_.assign(boundary_.vertex.size(), kNone);
    for (std::uint32_t v = 0; v < boundary_.vertex.size(); ++v) {
      if (!boundary_.is_rim(v)) continue;
      const auto& rim = boundary_.vertex[v];
      const Eigen::Vector3f image = view_.project(rim.point);
      if (!(image.z() > 0)) continue;
      const Eigen::Vector2f pixel = image.head<2>();
      if (!(pixel.x() > -0.5f && pixel.y() > -0.5f && pixel.x() < static_cast<float>(view_.cols()) - 0.5f &&
            pixel.y() < static_cast<float>(view_.rows()) - 0.5f))
        continue;
      const int x = static_cast<int>(std::lround(pixel.x())), y = static_cast<int>(std::lround(pixel.y()));
      if (!near_[view_.at(x, y)] || !is_seen(rim, x, y)) continue;
      node_of_[v] = static_cast<int>(nodes_.size());
      nodes_.push_back({pixel, rim.point, rim.normal, v});
      drop_corners_around(pixel, x, y);
    }
  }

  /// True when the measurement in the vertex's 3x3 neighbourhood puts a surface there.
  bool is_seen(const RimVertex& rim, int x, int y) const {
    const float range = rim.point.norm();
    const float cosine = UpdateView::facing(rim.normal, rim.point);
    if (cosine <= 0) return false;
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u) {
        if (!view_.inside(u, v) || !view_.measured(view_.at(u, v))) continue;
        const auto p = view_.at(u, v);
        const float distance = (view_.point[p].norm() - range) * std::max(cosine, settings_.triangle.gate.least_cosine);
        if (std::abs(distance) <=
            settings_.triangle.gate_sigmas * settings_.triangle.gate.spread(view_.sigma[p], cosine, 0))
          return true;
      }
    return false;
  }

  void drop_corners_around(const Eigen::Vector2f& pixel, int x, int y) {
    const int reach = static_cast<int>(std::ceil(
        std::max(settings_.gap_vertex_px, settings_.gap_vertex_leaf * static_cast<float>(settings_.leaves.leaf_max))));
    for (int v = std::max(0, y - reach); v <= std::min(view_.rows() - 1, y + reach); ++v)
      for (int u = std::max(0, x - reach); u <= std::min(view_.cols() - 1, x + reach); ++u) {
        int& corner = kept_[view_.at(u, v)];
        if (corner == kNone) continue;
        const float gap = std::max(
            settings_.gap_vertex_px,
            settings_.gap_vertex_leaf * static_cast<float>(corners_[static_cast<std::size_t>(corner)].spacing));
        if ((Eigen::Vector2f(static_cast<float>(u), static_cast<float>(v)) - pixel).squaredNorm() < gap * gap)
          corner = kNone;
      }
  }

  void drop_corners_at_edges() {
    std::vector<std::uint32_t> ends;
    for (std::uint32_t a = 0; a < nodes_.size(); ++a) {
      boundary_.open_from(nodes_[a].number, ends);
      for (auto end : ends) {
        if (node_of_[end] == kNone) continue;
        const auto b = static_cast<std::uint32_t>(node_of_[end]);
        rim_edges_.emplace_back(a, b);
        drop_corners_along(nodes_[a].pixel, nodes_[b].pixel);
      }
    }
  }

  void drop_corners_along(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
    const Eigen::Vector2f edge = b - a;
    const float length = edge.norm();
    if (length < 1e-3f) return;
    const Eigen::Vector2f across(-edge.y() / length, edge.x() / length);
    for (float s = 0; s <= length; s += 0.5f) {
      const Eigen::Vector2f p = a + edge * (s / length);
      const int x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
      for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u) {
          if (!view_.inside(u, v)) continue;
          int& corner = kept_[view_.at(u, v)];
          const Eigen::Vector2f away = Eigen::Vector2f(static_cast<float>(u), static_cast<float>(v)) - a;
          if (corner != kNone && std::abs(across.dot(away)) < settings_.gap_edge_px) corner = kNone;
        }
    }
  }

  void take_corner(const LeafCorner& c) {
    const auto x = static_cast<float>(c.x), y = static_cast<float>(c.y);
    nodes_.push_back({{x, y}, view_.ray(x, y) / c.disparity, normal_of(c)});
  }

  /// The normal of the plane of space whose disparity has the corner's value and gradient.
  Eigen::Vector3f normal_of(const LeafCorner& c) const {
    const float at_centre =
        c.disparity - c.a * (static_cast<float>(c.x) - view_.cx) - c.b * (static_cast<float>(c.y) - view_.cy);
    return -(view_.axes * Eigen::Vector3f(c.a * view_.fx, c.b * view_.fy, at_centre)).normalized();
  }

  void triangulate(std::vector<RimFace>& faces) {
    std::vector<GridPoint> points;
    points.reserve(nodes_.size());
    for (const auto& n : nodes_) points.push_back(GridPoint::of(n.pixel));
    Triangulation plane(std::move(points));
    for (const auto& [a, b] : rim_edges_) plane.keep_edge(a, b);
    const bool flip = view_.fx * view_.fy > 0;  // the image's second axis points down: positive area in it faces away
    for (auto t : plane.triangles()) {
      if (flip) std::swap(t[1], t[2]);
      consider(t, faces);
    }
  }

  void consider(const std::array<std::uint32_t, 3>& t, std::vector<RimFace>& faces) {
    Node* const n[3] = {&nodes_[t[0]], &nodes_[t[1]], &nodes_[t[2]]};
    if (!is_surface(view_, classes_, settings_.triangle, {n[0]->point, n[1]->point, n[2]->point},
                    {n[0]->normal, n[1]->normal, n[2]->normal}, {n[0]->pixel, n[1]->pixel, n[2]->pixel}))
      return;
    RimFace face;
    for (std::size_t k = 0; k < 3; ++k) {
      if (n[k]->number == RimVertex::kNew) n[k]->number = boundary_.add_vertex(view_, n[k]->point, n[k]->normal);
      face[k] = n[k]->number;
    }
    if (!boundary_.accepts(face)) return;
    boundary_.add(face);
    faces.push_back(face);
  }

  const UpdateView& view_;
  const std::vector<std::uint8_t>&classes_, &wanted_;
  const NewSurfaceSettings& settings_;
  Boundary& boundary_;
  std::vector<std::uint8_t> near_;  // [px] within a leaf of a wanted pixel
  std::vector<LeafCorner> corners_;
  std::vector<int> kept_;     // [px] the corner there, or kNone
  std::vector<int> node_of_;  // by boundary vertex
  std::vector<Node> nodes_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rim_edges_;  // open edges between nodes
};

}  // namespace

void make_surface(const UpdateView& view, const std::vector<std::uint8_t>& classes,
                  const std::vector<std::uint8_t>& wanted, const NewSurfaceSettings& settings, Boundary& boundary,
                  std::vector<RimFace>& faces) {
  SurfaceMaker(view, classes, wanted, settings, boundary).run(faces);
}

}  // namespace ppm
