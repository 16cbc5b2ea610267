#include "modules/maps/ppm/described_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ppm {
namespace {

constexpr float kLeastFacing = 0.26f;  // 75 degrees
constexpr float kInside = 1e-4f;       // barycentric: so far beside a face its edge still counts as the face

float interpolate(std::span<const float> values, const TexelTriangle& t) {
  return t.weight[0] * values[t.texel[0]] + t.weight[1] * values[t.texel[1]] + t.weight[2] * values[t.texel[2]];
}

/// The point of a face nearest to one that may lie beside it, nearest in barycentric coordinates.
std::array<float, 2> clamp_to_face(float u, float v) {
  u = std::clamp(u, 0.0f, 1.0f);
  v = std::clamp(v, 0.0f, 1.0f);
  if (u + v <= 1) return {u, v};
  u = (1 + u - v) / 2;
  return {u, 1 - u};
}

}  // namespace

TexturedFace textured_face(const PpmChunk& chunk, std::uint32_t f) {
  const Geometry& geometry = *chunk.geometry;
  const auto& [a, b, c] = geometry.face[f];
  const std::uint32_t n = geometry.divisions[f];
  return {{geometry.position[a], geometry.position[b], geometry.position[c]},
          n,
          chunk.texels->evidence[f],
          chunk.texels->view(geometry.first_texel[f], texel_count(n))};
}

DescribedSurface::DescribedSurface(std::span<const TexturedFace> faces, Meeting meeting)
    : faces_(faces), meeting_(meeting), aimed_(faces.size(), 0) {
  double extent = 0;
  plane_.reserve(faces.size());
  for (const auto& face : faces) {
    const Eigen::Vector3f e1 = face.corner[1] - face.corner[0], e2 = face.corner[2] - face.corner[0];
    const Eigen::Vector3f cross = e1.cross(e2);
    const float area2 = cross.squaredNorm();
    float farthest = 0;
    for (float m : face.texels.mean) farthest = std::max(farthest, std::abs(m));
    plane_.push_back({cross / std::sqrt(area2), e2.cross(cross) / area2, cross.cross(e1) / area2, farthest});
    extent += e1.cwiseAbs().cwiseMax(e2.cwiseAbs()).maxCoeff();
  }
  if (faces.empty()) return;
  cell_size_ = std::max(1.5f * static_cast<float>(extent / static_cast<double>(faces.size())), 1e-4f);
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const auto& [a, b, c] = faces[f].corner;
    cells(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), [&](const Cell& cell) { grid_[cell].push_back(f); });
  }
}

template <class Visit>
void DescribedSurface::cells(const Eigen::Vector3f& low, const Eigen::Vector3f& high, Visit visit) const {
  const Cell from = (low / cell_size_).array().floor().cast<int>(), to = (high / cell_size_).array().floor().cast<int>();
  for (int x = from.x(); x <= to.x(); ++x)
    for (int y = from.y(); y <= to.y(); ++y)
      for (int z = from.z(); z <= to.z(); ++z) visit(Cell(x, y, z));
}

void DescribedSurface::aim(const CastPlane& plane, float reach) {
  target_.clear();
  ++aim_;
  const Eigen::Vector3f a = plane.origin, b = a + plane.edge1, c = a + plane.edge2;
  const Eigen::Vector3f low = a.cwiseMin(b).cwiseMin(c).array() - reach, high = a.cwiseMax(b).cwiseMax(c).array() + reach;
  cells(low, high, [&](const Cell& cell) {
    const auto it = grid_.find(cell);
    if (it == grid_.end()) return;
    for (auto f : it->second) {
      if (aimed_[f] == aim_) continue;
      aimed_[f] = aim_;
      const auto& [p, q, r] = faces_[f].corner;
      if ((p.cwiseMax(q).cwiseMax(r).array() < low.array()).any() || (p.cwiseMin(q).cwiseMin(r).array() > high.array()).any())
        continue;
      if (const float facing = plane_[f].normal.dot(plane.normal); facing >= kLeastFacing) aim_at(plane, f, facing);
    }
  });
  if (target_.empty())
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      if (const float facing = plane_[f].normal.dot(plane.normal); facing >= kLeastFacing) aim_at(plane, f, facing);
  away_ = target_.empty();
  if (away_)
    for (std::uint32_t f = 0; f < faces_.size(); ++f) aim_at(plane, f, kLeastFacing);
  std::sort(target_.begin(), target_.end(), [](const Target& x, const Target& y) { return x.face < y.face; });
}

void DescribedSurface::aim_at(const CastPlane& plane, std::uint32_t f, float facing) {
  const Plane& face = plane_[f];
  auto linear = [&](const Eigen::Vector3f& axis) {
    return Linear{axis.dot(plane.origin - faces_[f].corner[0]), axis.dot(plane.edge1), axis.dot(plane.edge2)};
  };
  Target t{f, linear(face.u_axis), linear(face.v_axis), linear(face.normal), face.u_axis.dot(plane.normal),
           face.v_axis.dot(plane.normal), facing, 0};
  t.slack = kInside;
  if (meeting_ == Meeting::displaced)
    t.slack += std::max({std::abs(t.u_slope), std::abs(t.v_slope), std::abs(t.u_slope + t.v_slope)}) *
                          face.farthest_mean / facing;
  target_.push_back(t);
}

SurfaceHit DescribedSurface::cast(float a, float b) const {
  SurfaceHit best;
  best.offset = best.miss = std::numeric_limits<float>::infinity();
  float nearest = best.offset;
  for (const Target& t : target_) {
    const float base = -t.height.at(a, b) / t.facing;
    const float u = t.u.at(a, b) + base * t.u_slope, v = t.v.at(a, b) + base * t.v_slope;
    if (u < -t.slack || v < -t.slack || u + v > 1 + t.slack) continue;
    const SurfaceHit hit = meet(t, a, b);
    const float distance = std::abs(meeting_ == Meeting::seen ? base : hit.offset);
    if (hit.miss > 0 || !(distance < nearest)) continue;
    nearest = distance;
    best = hit;
  }
  if (best.miss == 0 && !away_) return best;
  for (const Target& t : target_) {
    const SurfaceHit hit = meet(t, a, b);
    if (std::hypot(hit.miss, hit.offset) < std::hypot(best.miss, best.offset)) best = hit;
  }
  if (away_) best.miss = std::numeric_limits<float>::infinity();
  return best;
}

/// The displaced face is a height over its plane: from a guess of the height, the point of the line at that height gives
/// the next guess. Converges by the factor slope of the texture times tangent of the angle between line and normal.
SurfaceHit DescribedSurface::meet(const Target& t, float a, float b) const {
  const TexturedFace& face = faces_[t.face];
  const float u = t.u.at(a, b), v = t.v.at(a, b), height = t.height.at(a, b);
  SurfaceHit hit{-height / t.facing, 0, t.face, {}};
  std::array<float, 2> line{}, on_face{};
  for (int step = 0; step < 4; ++step) {
    line = {u + hit.offset * t.u_slope, v + hit.offset * t.v_slope};
    on_face = clamp_to_face(line[0], line[1]);
    hit.texels = texel_triangle(face.divisions, on_face[0], on_face[1]);
    const float before = hit.offset;
    hit.offset = (interpolate(face.texels.mean, hit.texels) - height) / t.facing;
    if (meeting_ == Meeting::seen || std::abs(hit.offset - before) < 1e-6f) break;
  }
  if (line[0] >= -kInside && line[1] >= -kInside && line[0] + line[1] <= 1 + kInside) return hit;
  const auto& [p, q, r] = face.corner;
  hit.miss = std::max(((line[0] - on_face[0]) * (q - p) + (line[1] - on_face[1]) * (r - p)).norm(), 1e-9f);
  return hit;
}

}  // namespace ppm
