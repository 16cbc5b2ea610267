#include "tests/prediction/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "modules/maps/ppm/color_sample.hpp"
#include "modules/maps/ppm/texel_sample.hpp"
#include "tests/prediction/outline.hpp"

namespace ppm::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Triangle {
  Vector3d p0, e1, e2;
};

Triangle triangle_of(const PpmMap& map, std::uint32_t chunk, std::uint32_t face) {
  const Geometry& g = *map.table()[chunk].geometry;
  const auto& f = g.face[face];
  const Vector3d p0 = g.position[f[0]].cast<double>();
  return {p0, g.position[f[1]].cast<double>() - p0, g.position[f[2]].cast<double>() - p0};
}

double tolerance(double range, double cosine) {
  return kRangeShare * (1 + range) / std::max(std::abs(cosine), 1e-6);
}

class Judge {
 public:
  Judge(const PpmMap& map, const FaceTree& tree, const Prediction& view)
      : map_(map), tree_(tree), view_(view), origin_(view.T_map_camera.translation()) {}

  Tally all() {
    for (std::size_t p = 0; p < view_.range.size(); ++p) judge(p);
    return std::move(tally_);
  }

 private:
  Vector2d pixel(std::size_t p) const {
    const auto cols = static_cast<std::size_t>(view_.camera.cols);
    return {static_cast<double>(p % cols), static_cast<double>(p / cols)};
  }
  Vector3d direction(const Vector2d& at) const {
    return view_.T_map_camera.linear() * view_.camera.ray(at.x(), at.y()).normalized();
  }
  bool says(std::size_t p, const OracleHit& hit) const {
    return view_.chunk[p] == hit.chunk && (!view_.hit(p) || view_.face[p] == hit.face);
  }

  void judge(std::size_t p) {
    const Vector3d d = direction(pixel(p));
    const OracleHit exact = tree_.nearest(origin_, d);
    const Verdict verdict = says(p, exact) ? Verdict::same : explain(p, d, exact);
    ++tally_.pixels;
    ++tally_.count[static_cast<std::size_t>(verdict)];
    if (verdict == Verdict::fault) note(p, exact);
    if (!view_.hit(p)) return check_miss(p);
    ++tally_.hits;
    check_hit(p, d);
  }

  Verdict explain(std::size_t p, const Vector3d& d, const OracleHit& exact) const {
    if (ties(p, d, exact)) return Verdict::tie;
    if (within_edge(p, 0)) return Verdict::edge;
    if (undecided(p, d, 0)) return Verdict::sliver;
    const double closest = kClosest / view_.camera.ray(pixel(p).x(), pixel(p).y()).normalized().z();
    if (exact.range > closest) return Verdict::fault;
    const OracleHit beyond = tree_.nearest(origin_, d, closest);
    return says(p, beyond) || ties(p, d, beyond) || within_edge(p, closest) || undecided(p, d, closest)
               ? Verdict::close
               : Verdict::fault;
  }

  bool ties(std::size_t p, const Vector3d& d, const OracleHit& exact) const {
    if (!view_.hit(p) || !std::isfinite(exact.range)) return false;
    const Triangle t = triangle_of(map_, view_.chunk[p], view_.face[p]);
    const Triangle first = triangle_of(map_, exact.chunk, exact.face);
    const auto own = plane_crossing(t.p0, t.e1, t.e2, origin_, d),
               other = plane_crossing(first.p0, first.e1, first.e2, origin_, d);
    return own && own->inside(1e-9) && !(tree_.culls_back_faces() && own->cosine > 0) &&
           own->range - exact.range <= tolerance(own->range, own->cosine) + tolerance(exact.range, other->cosine);
  }

  /// Whether some ray near the pixel gives its answer: 16 of them on two rings.
  bool within_edge(std::size_t p, double closest) const {
    for (int i = 0; i < 16; ++i) {
      const double angle = M_PI / 4 * (i % 8), radius = i < 8 ? kEdge / 8 : kEdge;
      const Vector2d at = pixel(p) + radius * Vector2d(std::cos(angle), std::sin(angle));
      if (says(p, tree_.nearest(origin_, direction(at), closest))) return true;
    }
    return false;
  }

  double to_outline(std::size_t p, std::uint32_t chunk, std::uint32_t face, bool& inside) const {
    const Triangle t = triangle_of(map_, chunk, face);
    const Pose T_camera_map = view_.T_map_camera.inverse();
    const auto distance = outline_distance(
        {T_camera_map * t.p0, T_camera_map * Vector3d(t.p0 + t.e1), T_camera_map * Vector3d(t.p0 + t.e2)}, view_.camera,
        pixel(p));
    inside = distance.inside;
    return distance.px;
  }

  /// Whether the pixel may show its face at all, and all that the exact ray meets in front of it may be missed: each by
  /// an outline that passes within kEdge.
  bool undecided(std::size_t p, const Vector3d& d, double closest) const {
    bool inside = false;
    double range = INFINITY;
    if (view_.hit(p)) {
      const Triangle t = triangle_of(map_, view_.chunk[p], view_.face[p]);
      const auto own = plane_crossing(t.p0, t.e1, t.e2, origin_, d);
      const double px = to_outline(p, view_.chunk[p], view_.face[p], inside);
      if (!own || (tree_.culls_back_faces() && own->cosine > 1e-6) || (!inside && px > kEdge)) return false;
      range = own->range - tolerance(own->range, own->cosine);
    }
    for (const auto& hit : tree_.all(origin_, d)) {
      const bool own = view_.hit(p) && hit.chunk == view_.chunk[p] && hit.face == view_.face[p];
      if (!own && hit.range >= closest && hit.range < range && to_outline(p, hit.chunk, hit.face, inside) > kEdge)
        return false;
    }
    return true;
  }

  void check_miss(std::size_t p) {
    const float values[] = {view_.mean[p],           view_.variance[p], view_.normal[3 * p],  view_.normal[3 * p + 1],
                            view_.normal[3 * p + 2], view_.bary[2 * p], view_.bary[2 * p + 1]};
    const bool blank = view_.range[p] == Prediction::kMiss &&
                       std::all_of(std::begin(values), std::end(values), [](float v) { return v == 0; });
    if (!blank) tally_.range = INFINITY;
  }

  static void raise(double& worst, double error) { worst = std::isnan(error) ? INFINITY : std::max(worst, error); }

  void check_hit(std::size_t p, const Vector3d& d) {
    const Triangle t = triangle_of(map_, view_.chunk[p], view_.face[p]);
    const double u = view_.bary[2 * p], v = view_.bary[2 * p + 1];
    const Vector3d cross = t.e1.cross(t.e2), n = cross.normalized();
    const Vector3d normal(view_.normal[3 * p], view_.normal[3 * p + 1], view_.normal[3 * p + 2]);
    const auto at = plane_crossing(t.p0, t.e1, t.e2, origin_, d);
    if (!at) return raise(tally_.range, INFINITY);
    const double sides = t.e1.norm() + t.e2.norm(), corner = kCornerShare * (1 + at->range + sides);
    const double side = at->cosine > 0 ? -1 : 1;  // turned where the face is seen from behind
    raise(tally_.normal, (normal - side * n).norm() / (1e-6 + corner * sides / cross.norm()));
    const double allowed = tolerance(at->range, at->cosine) +
                           corner * (sides * sides / cross.norm() + 1 / std::max(std::abs(at->cosine), 1e-6));
    const double taken_back = beyond_edge(*at);
    raise(tally_.range, std::abs(view_.range[p] - at->range) / (allowed + taken_back));
    const double off = ((u - at->u) * t.e1 + (v - at->v) * t.e2).norm();
    raise(tally_.point, off / (allowed + taken_back));
    check_texture(p, static_cast<float>(side));
  }

  /// How far on the face a pixel that shows it from beyond its edge may be taken back, m.
  double beyond_edge(const Crossing& at) const {
    if (at.inside(0)) return 0;
    return kEdge * at.range / (std::min(view_.camera.fx, std::abs(view_.camera.fy)) * std::abs(at.cosine));
  }

  void check_texture(std::size_t p, float side) {
    const PpmChunk& chunk = map_.table()[view_.chunk[p]];
    const float u = view_.bary[2 * p], v = view_.bary[2 * p + 1];
    const TexelSample texel = linear_sample(*chunk.geometry, *chunk.texels, view_.face[p], u, v);
    raise(tally_.mean, std::abs(view_.mean[p] - side * texel.mean) / (1e-7 + kAttribute * std::abs(texel.mean)));
    raise(tally_.variance, std::abs(view_.variance[p] - texel.variance) / (kAttribute * texel.variance));
    const auto channels = static_cast<std::size_t>(view_.color_channels);
    if (channels == 0) return;
    const ColorSample color = linear_color(*chunk.geometry, *chunk.texels, view_.face[p], u, v);
    for (std::size_t c = 0; c < channels; ++c)
      raise(tally_.color, std::abs(view_.color[channels * p + c] - color.mean[c]) / kAttribute);
    raise(tally_.color,
          std::abs(view_.color_variance[p] - color.variance) / (kAttribute + kAttribute * color.variance));
  }

  void note(std::size_t p, const OracleHit& exact) {
    if (!tally_.first_fault.empty()) return;
    tally_.first_fault =
        fmt::format("pixel ({}, {}) shows chunk {} face {} at {} m; exact: chunk {} face {} at {} m", pixel(p).x(),
                    pixel(p).y(), view_.chunk[p], view_.face[p], view_.range[p], exact.chunk, exact.face, exact.range);
  }

  const PpmMap& map_;
  const FaceTree& tree_;
  const Prediction& view_;
  const Vector3d origin_;
  Tally tally_;
};

}  // namespace

std::string_view name_of(Verdict verdict) {
  constexpr std::string_view names[kVerdicts] = {"same", "tie", "edge", "sliver", "close", "fault"};
  return names[static_cast<std::size_t>(verdict)];
}

void Tally::add(const Tally& other) {
  pixels += other.pixels;
  hits += other.hits;
  for (std::size_t i = 0; i < kVerdicts; ++i) count[i] += other.count[i];
  for (auto error : {&Tally::range, &Tally::point, &Tally::normal, &Tally::mean, &Tally::variance, &Tally::color})
    this->*error = std::max(this->*error, other.*error);
  if (first_fault.empty()) first_fault = other.first_fault;
}

double Tally::doubtful() const {
  return static_cast<double>(of(Verdict::tie) + of(Verdict::edge) + of(Verdict::sliver)) /
         static_cast<double>(std::max<std::size_t>(pixels, 1));
}

double Tally::worst_error() const {
  return std::max({range, point, normal, mean, variance, color});
}

Tally judge(const PpmMap& map, const FaceTree& tree, const Prediction& view) {
  return Judge(map, tree, view).all();
}

}  // namespace ppm::test
