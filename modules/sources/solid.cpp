#include "modules/sources/solid.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {
namespace {

using Vec = Eigen::Vector3d;

SolidHit hit_box(const Vec& o, const Vec& d, const Vec& half) {
  double enter = -std::numeric_limits<double>::infinity(), leave = std::numeric_limits<double>::infinity();
  int axis = 0;
  for (int k = 0; k < 3; ++k) {
    if (d[k] == 0) {
      if (std::abs(o[k]) > half[k]) return {};
      continue;
    }
    const double s = std::copysign(half[k], d[k]), near = (-s - o[k]) / d[k], far = (s - o[k]) / d[k];
    if (near > enter) enter = near, axis = k;
    leave = std::min(leave, far);
  }
  if (enter > leave || enter < 0) return {};
  SolidHit hit{enter, Vec::Zero()};
  hit.normal[axis] = d[axis] > 0 ? -1 : 1;
  return hit;
}

SolidHit hit_sphere(const Vec& o, const Vec& d, double radius) {
  const double b = o.dot(d), h = b * b - (o.squaredNorm() - radius * radius);
  if (h < 0) return {};
  const double t = -b - std::sqrt(h);
  if (t < 0) return {};
  return {t, (o + t * d) / radius};
}

/// The later of entering the round side and the slab between the ends, if that is before leaving either.
SolidHit hit_cylinder(const Vec& o, const Vec& d, double radius, double half_height) {
  SolidHit hit{-std::numeric_limits<double>::infinity(), Vec::Zero()};
  double leave = std::numeric_limits<double>::infinity();
  const double a = d.head<2>().squaredNorm(), c = o.head<2>().squaredNorm() - radius * radius;
  if (a > 0) {
    const double b = o.head<2>().dot(d.head<2>()), h = b * b - a * c;
    if (h < 0) return {};
    hit.range_m = (-b - std::sqrt(h)) / a;
    leave = (-b + std::sqrt(h)) / a;
    hit.normal.head<2>() = (o + hit.range_m * d).head<2>() / radius;
  } else if (c > 0) {
    return {};
  }
  if (d.z() != 0) {
    const double s = std::copysign(half_height, d.z()), near = (-s - o.z()) / d.z();
    if (near > hit.range_m) hit = {near, Vec(0, 0, d.z() > 0 ? -1 : 1)};
    leave = std::min(leave, (s - o.z()) / d.z());
  } else if (std::abs(o.z()) > half_height) {
    return {};
  }
  if (hit.range_m > leave || hit.range_m < 0) return {};
  return hit;
}

/// Signed distance to a box, and in two dimensions to a cylinder's section, from the excess over the half sizes.
template <class V>
double outside_distance(const V& excess) {
  return excess.cwiseMax(0.0).norm() + std::min(excess.maxCoeff(), 0.0);
}

}  // namespace

SolidHit enter(const Solid& solid, const Vec& origin, const Vec& direction) {
  const Vec o = solid.R_world_local.transpose() * (origin - solid.center),
            d = solid.R_world_local.transpose() * direction;
  switch (solid.shape) {
    case Solid::Shape::box:
      return hit_box(o, d, solid.half);
    case Solid::Shape::cylinder:
      return hit_cylinder(o, d, solid.half.x(), solid.half.z());
    case Solid::Shape::sphere:
      return hit_sphere(o, d, solid.half.x());
  }
  return {};
}

double signed_distance(const Solid& solid, const Vec& p_world) {
  const Vec p = solid.R_world_local.transpose() * (p_world - solid.center);
  switch (solid.shape) {
    case Solid::Shape::box:
      return outside_distance(Vec(p.cwiseAbs() - solid.half));
    case Solid::Shape::cylinder:
      return outside_distance(Eigen::Vector2d(p.head<2>().norm() - solid.half.x(), std::abs(p.z()) - solid.half.z()));
    case Solid::Shape::sphere:
      return p.norm() - solid.half.x();
  }
  return 0;
}

Eigen::Vector3f albedo_at(const Solid& solid, const Vec& p_world) {
  if (solid.pattern.size.isZero()) return solid.albedo;
  // Half a cell off, so that no face of a centred solid lies between two cells.
  const Vec p = solid.R_world_local.transpose() * (p_world - solid.center);
  const Vec cell = (p.array() / solid.pattern.size.array() + 0.5).floor();
  return std::fmod(std::abs(cell.sum()), 2.0) == 1.0 ? solid.pattern.albedo : solid.albedo;
}

Eigen::AlignedBox3d bounds(const Solid& solid) {
  const Vec reach = solid.R_world_local.cwiseAbs() * solid.half;
  return {solid.center - reach, solid.center + reach};
}

}  // namespace ppm
