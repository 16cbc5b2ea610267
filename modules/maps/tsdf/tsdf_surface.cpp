#include "modules/maps/tsdf/tsdf_surface.hpp"

#include <open3d/pipelines/integration/UniformTSDFVolume.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ppm {

namespace {

constexpr int kShift = 4;  // log2 of TsdfMap::kBlock
constexpr int kMask = TsdfMap::kBlock - 1;
static_assert(1 << kShift == TsdfMap::kBlock);

Eigen::Vector3i floor_of(const Eigen::Vector3d& p) {
  return p.array().floor().cast<int>();
}

/// Range at which a ray leaves a cube of the lattice.
double exit_of(const Eigen::Vector3i& place, double edge_m, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction) {
  double exit = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0) continue;
    const double border = (place[i] + (direction[i] > 0 ? 1 : 0)) * edge_m;
    exit = std::min(exit, (border - origin[i]) / direction[i]);
  }
  return exit;
}

}  // namespace

TsdfSurface::TsdfSurface(const TsdfMap& map)
    : map_(map),
      voxel_m_(map.settings().voxel_size_m),
      block_m_(voxel_m_ * TsdfMap::kBlock),
      truncation_m_(map.settings().truncation_m),
      block_(map.blocks().find(place_)) {}

const TsdfBlock* TsdfSurface::block_at(const Eigen::Vector3i& place) {
  if (place != place_) {
    place_ = place;
    block_ = map_.blocks().find(place);
  }
  return block_;
}

TsdfSurface::Voxel TsdfSurface::voxel_at(const Eigen::Vector3i& voxel) {
  const auto* block = block_at({voxel.x() >> kShift, voxel.y() >> kShift, voxel.z() >> kShift});
  if (!block) return {};
  const int i = block->IndexOf(voxel.x() & kMask, voxel.y() & kMask, voxel.z() & kMask);
  const auto& found = block->voxels_[static_cast<std::size_t>(i)];
  return {found.tsdf_, found.weight_};
}

std::optional<double> TsdfSurface::distance(const Eigen::Vector3d& p) {
  const Eigen::Vector3d at = p / voxel_m_ - Eigen::Vector3d::Constant(0.5);
  const Eigen::Vector3d low = at.array().floor();
  const Eigen::Vector3d w = at - low;
  const Eigen::Vector3i first = low.cast<int>();
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i step(corner >> 2, corner >> 1 & 1, corner & 1);
    const auto voxel = voxel_at(first + step);
    if (voxel.weight == 0) return std::nullopt;
    const double weight = (step.x() ? w.x() : 1 - w.x()) * (step.y() ? w.y() : 1 - w.y()) * (step.z() ? w.z() : 1 - w.z());
    sum += weight * static_cast<double>(voxel.distance);
  }
  return sum;
}

std::optional<double> TsdfSurface::distance_or_far(const Eigen::Vector3d& p) {
  constexpr float kFar = 0.6f;
  const auto nearest = voxel_at(floor_of(p / voxel_m_));
  if (nearest.weight == 0) return std::nullopt;
  return nearest.distance > kFar ? std::optional(static_cast<double>(nearest.distance)) : distance(p);
}

std::optional<TsdfSurface::Point> TsdfSurface::look(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                                    double range_most_m) {
  constexpr double kCaution = 0.8;  // distances are along other rays than this one
  const double nudge = 1e-4 * voxel_m_;
  std::optional<double> before;
  double before_m = 0, range = 0;
  while (range < range_most_m) {
    const Eigen::Vector3d p = origin + range * direction;
    const Eigen::Vector3i place = floor_of(p / block_m_);
    if (!block_at(place)) {
      before.reset();
      range = std::max(range, exit_of(place, block_m_, origin, direction)) + nudge;
      continue;
    }
    const auto here = distance_or_far(p);
    if (here && before && *before > 0 && *here <= 0)
      return surface_between(before_m, *before, range, *here, origin, direction);
    before = here;
    before_m = range;
    range += here && *here > 0 ? std::max(kCaution * *here * truncation_m_, voxel_m_ / 2) : voxel_m_;
  }
  return std::nullopt;
}

TsdfSurface::Point TsdfSurface::surface_between(double before_m, double before, double after_m, double after,
                                                const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  constexpr int kSteps = 3;
  for (int i = 0; i < kSteps; ++i) {
    const double middle_m = before_m + (after_m - before_m) * before / (before - after);
    const auto middle = distance(origin + middle_m * direction);
    if (!middle) break;
    (*middle > 0 ? before_m : after_m) = middle_m;
    (*middle > 0 ? before : after) = *middle;
  }
  Point point;
  point.range_m = before_m + (after_m - before_m) * before / (before - after);
  const Eigen::Vector3d p = origin + point.range_m * direction;
  point.normal = normal_at(p);
  point.weight = voxel_at(floor_of(p / voxel_m_)).weight;
  return point;
}

Eigen::Vector3f TsdfSurface::normal_at(const Eigen::Vector3d& p) {
  Eigen::Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = voxel_m_ * Eigen::Vector3d::Unit(axis);
    const auto above = distance(p + step), below = distance(p - step);
    if (!above || !below) return Eigen::Vector3f::Zero();
    gradient[axis] = *above - *below;
  }
  const double length = gradient.norm();
  return length > 0 ? Eigen::Vector3f((gradient / length).cast<float>()) : Eigen::Vector3f::Zero();
}

}  // namespace ppm
