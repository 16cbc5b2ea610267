#include "modules/maps/ppm/hole_fill.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {
namespace {

using Loop = std::vector<std::uint32_t>;

/// Quality of a triangle: 4 sqrt(3) area / sum of squared edges, 1 for an equilateral one. Signed by the side of `up`.
float quality(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c, const Eigen::Vector3f& up) {
  const float squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return 2 * std::sqrt(3.0f) * up.dot((b - a).cross(c - a)) / squares;
}

class HoleFiller {
 public:
  HoleFiller(const UpdateView& view, const HoleSettings& settings, Boundary& boundary, std::vector<RimFace>& faces)
      : view_(view), settings_(settings), boundary_(boundary), faces_(faces) {}

  void fill(Loop loop) {
    std::reverse(loop.begin(), loop.end());  // filling faces run against the open edges
    if (!is_fillable(loop)) return;
    std::vector<RimFace> patch;
    while (loop.size() >= 3) {
      const int ear = best_ear(loop);
      if (ear < 0) return;
      const auto n = static_cast<int>(loop.size());
      patch.push_back({loop[at(ear - 1, n)], loop[at(ear, n)], loop[at(ear + 1, n)]});
      if (loop.size() == 3) break;
      loop.erase(loop.begin() + ear);
    }
    if (std::none_of(patch.begin(), patch.end(), [&](const RimFace& f) { return !is_plausible(f); })) add(patch);
  }

 private:
  static std::size_t at(int i, int n) { return static_cast<std::size_t>((i + n) % n); }
  const Eigen::Vector3f& point(std::uint32_t v) const { return boundary_.vertex[v].point; }

  /// Sets up_ to the loop's normal (Newell). False where it is too long, or looks away from the camera.
  bool is_fillable(const Loop& loop) {
    float perimeter = 0;
    up_.setZero();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const auto &a = point(loop[k]), &b = point(loop[(k + 1) % loop.size()]);
      perimeter += (b - a).norm();
      up_ += (a - point(loop[0])).cross(b - point(loop[0]));
    }
    if (perimeter > settings_.perimeter_most || up_.norm() < 1e-9f) return false;
    up_.normalize();
    return UpdateView::facing(up_, point(loop[0])) > 0;
  }

  int best_ear(const Loop& loop) const {
    const auto n = static_cast<int>(loop.size());
    int best = -1;
    float most = 1e-3f;
    for (int k = 0; k < n; ++k) {
      const RimFace f{loop[at(k - 1, n)], loop[at(k, n)], loop[at(k + 1, n)]};
      const float q = quality(point(f[0]), point(f[1]), point(f[2]), up_);
      if (q <= most || (n > 3 && !is_empty(f, loop))) continue;
      if (n > 3 && !boundary_.accepts_edge(f[2], f[0])) continue;
      most = q;
      best = k;
    }
    return best;
  }

  /// No other vertex of the loop lies above or below the ear.
  bool is_empty(const RimFace& f, const Loop& loop) const {
    for (auto v : loop) {
      if (v == f[0] || v == f[1] || v == f[2]) continue;
      bool inside = true;
      for (std::size_t k = 0; k < 3 && inside; ++k) {
        const auto &a = point(f[k]), &b = point(f[(k + 1) % 3]);
        inside = up_.dot((b - a).cross(point(v) - a)) >= 0;
      }
      if (inside) return false;
    }
    return true;
  }

  bool is_plausible(const RimFace& f) const {
    const Eigen::Vector3f cross = (point(f[1]) - point(f[0])).cross(point(f[2]) - point(f[0]));
    const float twice_area = cross.norm();
    if (!(twice_area > 1e-7f)) return false;
    const Eigen::Vector3f normal = cross / twice_area;
    for (auto v : f)
      if (boundary_.vertex[v].normal.dot(normal) < settings_.cosine_least) return false;
    const Eigen::Vector3f centroid = (point(f[0]) + point(f[1]) + point(f[2])) / 3;
    const Eigen::Vector3f image = view_.project(centroid);
    const int x = static_cast<int>(std::lround(image.x())), y = static_cast<int>(std::lround(image.y()));
    if (!view_.inside(x, y)) return false;
    const auto p = view_.at(x, y);
    if (!view_.measured(p)) return true;
    const float distance = normal.dot(view_.point[p] - centroid);  // negative behind
    return distance >=
           -settings_.gate_sigmas * settings_.gate.spread(view_.sigma[p], UpdateView::facing(normal, centroid), 0);
  }

  void add(const std::vector<RimFace>& patch) {
    for (const auto& f : patch)
      if (boundary_.accepts(f)) {
        boundary_.add(f);
        faces_.push_back(f);
      }
  }

  const UpdateView& view_;
  const HoleSettings& settings_;
  Boundary& boundary_;
  std::vector<RimFace>& faces_;
  Eigen::Vector3f up_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> small_loops(const Boundary& boundary, const std::vector<std::uint8_t>& usable,
                                                    int edges_most) {
  std::vector<Loop> loops;
  std::vector<int> place(usable.size(), -1);  // in the path, or -1
  // Ends of open edges that no path has used: those of vertex v in ends[first[v]] .. ends[last[v] - 1].
  std::vector<std::uint32_t> ends, first(usable.size()), last(usable.size()), of_one;
  for (std::uint32_t v = 0; v < usable.size(); ++v) {
    first[v] = static_cast<std::uint32_t>(ends.size());
    if (usable[v]) {
      boundary.open_from(v, of_one);
      for (auto e : of_one)
        if (usable[e]) ends.push_back(e);
      std::sort(ends.begin() + first[v], ends.end(), std::greater<>());
    }
    last[v] = static_cast<std::uint32_t>(ends.size());
  }
  const auto has_left = [&](std::uint32_t v) { return last[v] > first[v]; };
  for (std::uint32_t start = 0; start < usable.size(); ++start)
    while (has_left(start)) {
      Loop path{start};
      place[start] = 0;
      while (!path.empty() && has_left(path.back())) {
        const auto next = ends[--last[path.back()]];
        if (place[next] < 0) {
          place[next] = static_cast<int>(path.size());
          path.push_back(next);
          continue;
        }
        // The path has come back to `next`: what lies between is a loop of its own.
        const auto from = path.begin() + place[next];
        if (path.end() - from >= 3 && path.end() - from <= edges_most) loops.emplace_back(from, path.end());
        for (auto it = from + 1; it != path.end(); ++it) place[*it] = -1;
        path.erase(from + 1, path.end());
      }
      for (auto v : path) place[v] = -1;
    }
  return loops;
}

void fill_holes(const UpdateView& view, const HoleSettings& settings, Boundary& boundary, std::vector<RimFace>& faces) {
  if (settings.edges_most < 3) return;
  std::vector<std::uint8_t> usable(boundary.vertex.size());
  for (std::size_t v = 0; v < usable.size(); ++v) {
    const Eigen::Vector3f image = view.project(boundary.vertex[v].point);
    usable[v] = image.z() > 0 && image.x() >= 0 && image.y() >= 0 && image.x() <= static_cast<float>(view.cols() - 1) &&
                image.y() <= static_cast<float>(view.rows() - 1);
  }
  HoleFiller filler(view, settings, boundary, faces);
  for (auto& loop : small_loops(boundary, usable, settings.edges_most)) filler.fill(std::move(loop));
}

}  // namespace ppm
