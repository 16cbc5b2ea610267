#include "modules/prediction/voxel_ray.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ppm {

namespace {

constexpr float kLogisticVariance = static_cast<float>(std::numbers::pi * std::numbers::pi / 3);  // of scale 1

/// A place on a ray: the voxel that it is in, and where it entered it.
struct Place {
  Cell voxel;
  float t;
};

Place place_of(const VoxelRay& ray, float t) {
  const Eigen::Vector3f p = ray.at(t);
  return {{floor_of(p.x()), floor_of(p.y()), floor_of(p.z())}, t};
}

/// Across the aligned cube of 2^log2 voxels around a place. The axis that is left goes to the next voxel exactly; the others
/// stay in the cube whatever rounding says, so that the walk always moves on.
void leave_cube(const VoxelRay& ray, int log2, Place& at) {
  const int size = 1 << log2;
  const Cell low(at.voxel.x() >> log2 << log2, at.voxel.y() >> log2 << log2, at.voxel.z() >> log2 << log2);
  int axis = 0;
  float out = std::numeric_limits<float>::infinity();
  for (int a = 0; a < 3; ++a) {
    const int face = ray.direction[a] > 0 ? low[a] + size : low[a];
    const float t = (static_cast<float>(face) - ray.origin[a]) * ray.inverse[a];
    axis = t < out ? a : axis;
    out = std::min(out, t);
  }
  at.t = std::max(at.t, out);
  const Eigen::Vector3f p = ray.at(at.t);
  for (int a = 0; a < 3; ++a) at.voxel[a] = std::clamp(floor_of(p[a]), low[a], low[a] + size - 1);
  at.voxel[axis] = ray.direction[axis] > 0 ? low[axis] + size : low[axis] - 1;
}

/// Walks from voxel to voxel: where the ray is, and where it leaves.
class VoxelWalk {
 public:
  VoxelWalk(const VoxelRay& ray, const Place& at) : voxel(at.voxel), t(at.t) {
    for (int a = 0; a < 3; ++a) {
      const bool up = ray.direction[a] > 0;
      step_[a] = up ? 1 : -1;
      apart_[a] = std::abs(ray.inverse[a]);
      next_[a] = (static_cast<float>(voxel[a] + (up ? 1 : 0)) - ray.origin[a]) * ray.inverse[a];
    }
  }
  float out() const { return next_.minCoeff(); }
  void advance() {
    if (next_.x() < next_.y() && next_.x() < next_.z())
      across<0>();
    else if (next_.y() < next_.z())
      across<1>();
    else
      across<2>();
  }

  Cell voxel;
  float t;

 private:
  template <int axis>
  void across() {
    t = next_[axis];
    next_[axis] += apart_[axis];
    voxel[axis] += step_[axis];
  }

  Eigen::Vector3i step_;
  Eigen::Vector3f apart_, next_;
};

float probability(float log_odds) {
  return 1 / (1 + std::exp(-log_odds));
}

class Tracer {
 public:
  Tracer(const VoxelRay& ray, const VoxelRayOptions& options, VoxelLeaves& leaves)
      : ray_(ray), options_(options), leaves_(leaves) {}

  VoxelHit trace(float start) {
    Place at = place_of(ray_, std::max(ray_.from, start));
    VoxelHit hit;
    while (at.t < ray_.to) {
      const VoxelLeaf& leaf = leaves_.of(at.voxel.x(), at.voxel.y(), at.voxel.z());
      if (!leaf.occupied)
        leave_cube(ray_, leaf.log2_empty, at);
      else if (walk(leaf, at, hit))
        return hit;
    }
    return {};
  }

 private:
  /// Through the voxels of a leaf, up to the first that shows a surface.
  bool walk(VoxelLeaf leaf, Place& at, VoxelHit& hit) {  // a copy: settle() looks at other leaves
    VoxelWalk way(ray_, at);
    const Cell low = leaf.cell * kVdbLeafEdge;
    auto inside = [&] {
      const int x = way.voxel.x() - low.x(), y = way.voxel.y() - low.y(), z = way.voxel.z() - low.z();
      return ((x | y | z) & ~(kVdbLeafEdge - 1)) == 0;
    };
    for (; inside(); way.advance()) {
      if (leaf.at(way.voxel.x(), way.voxel.y(), way.voxel.z()) <= 0 || !settle(way, hit)) continue;
      hit.voxel = way.voxel;
      hit.chunk = leaf.chunk;
      return true;
    }
    at = {way.voxel, way.t};
    return false;
  }

  bool settle(const VoxelWalk& way, VoxelHit& hit) {
    switch (options_.surface) {
      case VoxelSurface::crossing:
        return settle_crossing(way, hit);
      case VoxelSurface::cell:
        return settle_cell(way, hit);
      case VoxelSurface::expected:
        return settle_expected(way, hit);
    }
    return false;
  }

  bool settle_cell(const VoxelWalk& way, VoxelHit& hit) const {
    const Eigen::Vector3f centre = way.voxel.cast<float>() + Eigen::Vector3f::Constant(0.5f);
    hit.range = std::max((centre - ray_.origin).dot(ray_.direction), 0.0f);
    hit.variance = 1.0f / 12;
    return true;
  }

  // The voxel's own share of the ray may still lie where the log odds between the centres are below 0: it grazes.
  bool settle_crossing(const VoxelWalk& way, VoxelHit& hit) {
    constexpr int kBack = 3;  // voxels that the crossing may lie before the first voxel above 0
    float behind = 0.5f * (way.t + way.out());
    float above = leaves_.log_odds(ray_.at(behind));
    if (!(above > 0)) return false;
    float front = behind, below = above;
    for (int step = 0; step < kBack && below > 0 && front > ray_.from; ++step) {
      behind = front, above = below;
      front = std::max(front - 1, ray_.from);
      below = leaves_.log_odds(ray_.at(front));
    }
    const float rise = above - below;
    hit.range = below < 0 ? front + (behind - front) * (-below / rise) : behind;
    const float slope = rise / std::max(behind - front, 1e-3f);
    const float profile = slope > 0 ? kLogisticVariance / (slope * slope) : 1.0f;
    hit.variance = std::min(profile, 1.0f) + options_.cell_sigma * options_.cell_sigma;
    return true;
  }

  // p_k prod (1 - p_j) over the voxels from some before the first above 0 to where hardly anything is left.
  bool settle_expected(const VoxelWalk& first, VoxelHit& hit) {
    constexpr float kReach = 3, kLeft = 1e-3f;
    const float from = std::max(first.t - kReach, ray_.from), to = first.out() + kReach;
    float left = 1, sum = 0, mean = 0, square = 0;
    for (VoxelWalk way(ray_, place_of(ray_, from)); left > kLeft && way.t < to; way.advance()) {
      const float length = way.out() - way.t, middle = way.t + 0.5f * length - first.t;
      const float here = left * probability(leaves_.log_odds(way.voxel.x(), way.voxel.y(), way.voxel.z()));
      sum += here;
      mean += here * middle;
      square += here * (middle * middle + length * length / 12);
      left -= here;
    }
    mean /= sum;
    hit.range = std::max(first.t + mean, 0.0f);
    hit.variance = std::max(square / sum - mean * mean, 0.0f) + options_.cell_sigma * options_.cell_sigma;
    return true;
  }

  const VoxelRay& ray_;
  const VoxelRayOptions& options_;
  VoxelLeaves& leaves_;
};

}  // namespace

VoxelRay VoxelRay::make(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
  constexpr float kLeast = 1e-6f;
  VoxelRay ray{origin, direction, {}, 0, std::numeric_limits<float>::infinity()};
  for (int a = 0; a < 3; ++a)
    if (std::abs(direction[a]) < kLeast) ray.direction[a] = std::copysign(kLeast, direction[a]);
  ray.inverse = ray.direction.cwiseInverse();
  return ray;
}

bool VoxelRay::clip(const Eigen::Array3f& low, const Eigen::Array3f& high) {
  const Eigen::Array3f a = (low - origin.array()) * inverse.array(), b = (high - origin.array()) * inverse.array();
  from = std::max(from, a.min(b).maxCoeff());
  to = std::min(to, a.max(b).minCoeff());
  return from < to;
}

VoxelHit trace(const VoxelRay& ray, const VoxelRayOptions& options, VoxelLeaves& leaves, float start) {
  return Tracer(ray, options, leaves).trace(start);
}

Eigen::Vector3f normal_of(const VoxelRay& ray, const VoxelHit& hit, const VoxelRayOptions& options,
                          VoxelLeaves& leaves) {
  constexpr float kLevel = 1e-3f;
  const Eigen::Vector3f p = ray.at(hit.range);
  Eigen::Vector3f rise;
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector3f reach = options.normal_reach * Eigen::Vector3f::Unit(a);
    rise[a] = leaves.log_odds(p + reach) - leaves.log_odds(p - reach);
  }
  if (!(rise.squaredNorm() > kLevel * kLevel)) return -ray.direction;
  const Eigen::Vector3f normal = rise.normalized();
  return normal.dot(ray.direction) > 0 ? Eigen::Vector3f(-normal) : normal;
}

}  // namespace ppm
