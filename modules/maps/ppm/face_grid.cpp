#include "modules/maps/ppm/face_grid.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Range at which a ray meets a triangle from its front; infinite where it does not. Moeller and Trumbore, "Fast,
/// minimum storage ray/triangle intersection", 1997.
double range_to(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge1, const Eigen::Vector3d& edge2,
                const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d p = direction.cross(edge2);
  const double det = edge1.dot(p);  // > 0: the ray comes from where the face winds counter-clockwise
  if (det <= 0) return kInfinity;
  const Eigen::Vector3d s = origin - corner;
  const double u = s.dot(p);
  if (u < 0 || u > det) return kInfinity;
  const Eigen::Vector3d q = s.cross(edge1);
  const double v = direction.dot(q);
  if (v < 0 || u + v > det) return kInfinity;
  return edge2.dot(q) / det;
}

/// Walks along a ray from cell to cell. Amanatides and Woo, "A fast voxel traversal algorithm", 1987.
class CellWalk {
 public:
  CellWalk(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double start, double cell_m) {
    const Eigen::Vector3d at = (origin + start * direction) / cell_m;
    for (int k = 0; k < 3; ++k) {
      cell_[k] = static_cast<int>(std::floor(at[k]));
      step_[k] = direction[k] > 0 ? 1 : -1;
      const double speed = std::abs(direction[k]) / cell_m;
      per_cell_[k] = speed > 0 ? 1 / speed : kInfinity;
      const double left = direction[k] > 0 ? cell_[k] + 1 - at[k] : at[k] - cell_[k];
      exit_[k] = speed > 0 ? start + left / speed : kInfinity;
    }
  }
  const Cell& cell() const { return cell_; }
  double exit() const { return exit_.minCoeff(); }  ///< range at which the ray leaves the cell
  void next() {
    Eigen::Index k = 0;
    exit_.minCoeff(&k);
    cell_[k] += step_[k];
    exit_[k] += per_cell_[k];
  }

 private:
  Cell cell_, step_;
  Eigen::Vector3d per_cell_, exit_;
};

/// The ranges at which a ray enters and leaves a box; enter > leave where it misses it.
std::pair<double, double> span_in(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) {
  double enter = 0, leave = kInfinity;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0) {
      if (origin[k] < box.min()[k] || origin[k] > box.max()[k]) return {1, 0};
      continue;
    }
    const double a = (box.min()[k] - origin[k]) / direction[k], b = (box.max()[k] - origin[k]) / direction[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return {enter, leave};
}

}  // namespace

FaceGrid::FaceGrid(const PpmMap& map, double cell_m) : cell_m_(cell_m) {
  PPM_CHECK(cell_m > 0, "cells of {} m", cell_m);
  for (std::uint32_t c = 0; c < map.table().size(); ++c) {
    const Geometry& g = *map.table()[c].geometry;
    for (std::uint32_t f = 0; f < g.face.size(); ++f) {
      const Eigen::Vector3d a = g.position[g.face[f][0]].cast<double>();
      const Corners corners{a, g.position[g.face[f][1]].cast<double>() - a, g.position[g.face[f][2]].cast<double>() - a,
                            c, f};
      insert(static_cast<std::uint32_t>(faces_.size()), corners);
      faces_.push_back(corners);
    }
  }
}

Cell FaceGrid::cell_of(const Eigen::Vector3d& p) const {
  return (p / cell_m_).array().floor().cast<int>();
}

void FaceGrid::insert(std::uint32_t number, const Corners& corners) {
  Eigen::AlignedBox3d box(corners.origin);
  box.extend(corners.origin + corners.edge1);
  box.extend(corners.origin + corners.edge2);
  box_.extend(box);
  const Cell low = cell_of(box.min()), high = cell_of(box.max());
  for (int x = low.x(); x <= high.x(); ++x)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int z = low.z(); z <= high.z(); ++z) cells_[{x, y, z}].push_back(number);
}

std::optional<FaceGrid::Hit> FaceGrid::first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                                 double from, double to) const {
  if (faces_.empty()) return std::nullopt;
  const auto [enter, leave] = span_in(box_, origin, direction);
  const double start = std::max(from, enter), end = std::min(to, leave + cell_m_);
  if (start > end) return std::nullopt;
  double best = to;
  const Corners* met = nullptr;
  for (CellWalk walk(origin, direction, start, cell_m_);; walk.next()) {
    if (const auto found = cells_.find(walk.cell()); found != cells_.end())
      for (auto number : found->second) {
        const Corners& f = faces_[number];
        const double range = range_to(f.origin, f.edge1, f.edge2, origin, direction);
        if (range <= from || range >= best) continue;
        best = range;
        met = &f;
      }
    if (std::min(best, end) <= walk.exit()) break;
  }
  if (!met) return std::nullopt;
  return Hit{best, met->edge1.cross(met->edge2).normalized().cast<float>(), met->chunk, met->face};
}

}  // namespace ppm
