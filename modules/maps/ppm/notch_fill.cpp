#include "modules/maps/ppm/notch_fill.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

namespace ppm {
namespace {

class NotchFiller {
 public:
  NotchFiller(const UpdateView& view, const std::vector<std::uint8_t>& classes, const NotchSettings& settings,
              Boundary& boundary, std::vector<RimFace>& faces)
      : view_(view), classes_(classes), settings_(settings), boundary_(boundary), faces_(faces) {}

  void run() {
    const auto n = static_cast<std::uint32_t>(boundary_.vertex.size());
    into_.resize(n);
    starts_.reserve(2 * n);
    pixel_.resize(n);
    usable_.resize(n);
    for (std::uint32_t v = 0; v < n; ++v) {
      const Eigen::Vector3f image = view_.project(boundary_.vertex[v].point);
      pixel_[v] = image.head<2>();
      usable_[v] = image.z() > 0 && image.x() >= 0 && image.y() >= 0 &&
                   image.x() <= static_cast<float>(view_.cols() - 1) &&
                   image.y() <= static_cast<float>(view_.rows() - 1);
    }
    std::vector<std::uint32_t> ends;
    for (std::uint32_t v = 0; v < n; ++v) {
      boundary_.open_from(v, ends);
      for (auto e : ends) add_into(e, v);
      if (usable_[v] && !ends.empty()) bucket(v).push_back(v);
      if (usable_[v] && !ends.empty()) todo_.push_back(v);
    }
    while (!todo_.empty()) {
      const auto q = todo_.front();
      todo_.pop_front();
      visit(q);
    }
  }

 private:
  static constexpr int kCell = 8;  // px
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Start {
    std::uint32_t vertex, next;
  };
  struct Into {
    std::uint32_t first = kNone, last = kNone;  // in starts_
  };

  /// Notes an open edge from `start`, after those that end there already.
  void add_into(std::uint32_t end, std::uint32_t start) {
    const auto number = static_cast<std::uint32_t>(starts_.size());
    starts_.push_back({start, kNone});
    Into& into = into_[end];
    (into.first == kNone ? into.first : starts_[into.last].next) = number;
    into.last = number;
  }

  std::vector<std::uint32_t>& bucket(std::uint32_t v) {
    if (buckets_.empty())
      buckets_.resize(static_cast<std::size_t>((view_.cols() / kCell + 1) * (view_.rows() / kCell + 1)));
    return buckets_[cell(static_cast<int>(pixel_[v].x()) / kCell, static_cast<int>(pixel_[v].y()) / kCell)];
  }
  std::size_t cell(int x, int y) const { return static_cast<std::size_t>(y * (view_.cols() / kCell + 1) + x); }
  const Eigen::Vector3f& point(std::uint32_t v) const { return boundary_.vertex[v].point; }

  void visit(std::uint32_t q) {
    boundary_.open_from(q, ends_);
    for (auto r : ends_)
      for (auto i = into_[q].first; i != kNone; i = starts_[i].next) {
        const auto p = starts_[i].vertex;
        if (p == r || !usable_[p] || !usable_[r] || !boundary_.is_open(p, q) || !is_notch(p, q, r)) continue;
        const RimFace face{p, r, q};
        if (!boundary_.accepts(face) || !is_good(face)) continue;
        boundary_.add(face);
        faces_.push_back(face);
        if (boundary_.is_open(p, r)) add_into(r, p);
        todo_.push_back(p);
        todo_.push_back(r);
        return;
      }
  }

  /// The angle from q->p to q->r, counter-clockwise seen from the camera, is the open one.
  bool is_notch(std::uint32_t p, std::uint32_t q, std::uint32_t r) const {
    const Eigen::Vector3f u = point(p) - point(q), v = point(r) - point(q);
    const float most = settings_.edge_most * settings_.edge_most;
    if (u.squaredNorm() > most || v.squaredNorm() > most) return false;
    const Eigen::Vector3f cross = u.cross(v);
    if (cross.dot(point(q)) >= 0) return false;  // it would look away from the camera
    return std::atan2(cross.norm(), u.dot(v)) <= settings_.angle_most;
  }

  bool is_good(const RimFace& f) {
    const std::array<Eigen::Vector3f, 3> corner{point(f[0]), point(f[1]), point(f[2])};
    const std::array<Eigen::Vector2f, 3> pixel{pixel_[f[0]], pixel_[f[1]], pixel_[f[2]]};
    const Eigen::Vector3f normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    std::array<Eigen::Vector3f, 3> normals;
    for (std::size_t k = 0; k < 3; ++k) {
      normals[k] = boundary_.vertex[f[k]].normal;
      if (normals[k].dot(normal) < settings_.cosine_least) return false;
    }
    return is_surface(view_, classes_, settings_.triangle, corner, normals, pixel) && is_empty(f, pixel);
  }

  /// No other boundary vertex is seen inside the face.
  bool is_empty(const RimFace& f, const std::array<Eigen::Vector2f, 3>& t) const {
    const Eigen::Vector2f low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
    const float side = view_.fx * view_.fy > 0 ? -1.0f : 1.0f;
    for (int y = static_cast<int>(low.y()) / kCell; y <= static_cast<int>(high.y()) / kCell; ++y)
      for (int x = static_cast<int>(low.x()) / kCell; x <= static_cast<int>(high.x()) / kCell; ++x)
        for (auto v : buckets_[cell(x, y)]) {
          if (v == f[0] || v == f[1] || v == f[2]) continue;
          bool inside = true;
          for (std::size_t k = 0; k < 3 && inside; ++k) {
            const Eigen::Vector2f e = t[(k + 1) % 3] - t[k], d = pixel_[v] - t[k];
            inside = side * (e.x() * d.y() - e.y() * d.x()) > 0;
          }
          if (inside && boundary_.is_rim(v)) return false;
        }
    return true;
  }

  const UpdateView& view_;
  const std::vector<std::uint8_t>& classes_;
  const NotchSettings& settings_;
  Boundary& boundary_;
  std::vector<RimFace>& faces_;
  std::vector<Into> into_;  // by vertex: the starts of open edges into it
  std::vector<Start> starts_;
  std::vector<std::vector<std::uint32_t>> buckets_;  // vertices by cell of the image
  std::vector<Eigen::Vector2f> pixel_;
  std::vector<std::uint8_t> usable_;
  std::deque<std::uint32_t> todo_;
  std::vector<std::uint32_t> ends_;
};

}  // namespace

void fill_notches(const UpdateView& view, const std::vector<std::uint8_t>& classes, const NotchSettings& settings,
                  Boundary& boundary, std::vector<RimFace>& faces) {
  if (settings.angle_most > 0) NotchFiller(view, classes, settings, boundary, faces).run();
}

}  // namespace ppm
