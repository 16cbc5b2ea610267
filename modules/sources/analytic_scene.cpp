#include "modules/sources/analytic_scene.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

using Vec = Eigen::Vector3d;

/// An intersection in a solid's local frame.
struct LocalHit {
  double t = std::numeric_limits<double>::infinity();
  Vec normal = Vec::Zero();
};

LocalHit hit_box(const Vec& o, const Vec& d, const Vec& half) {
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
  LocalHit hit{enter, Vec::Zero()};
  hit.normal[axis] = d[axis] > 0 ? -1 : 1;
  return hit;
}

LocalHit hit_sphere(const Vec& o, const Vec& d, double radius) {
  const double b = o.dot(d), h = b * b - (o.squaredNorm() - radius * radius);
  if (h < 0) return {};
  const double t = -b - std::sqrt(h);
  if (t < 0) return {};
  return {t, (o + t * d) / radius};
}

/// The later of entering the round side and the slab between the ends, if that is before leaving either.
LocalHit hit_cylinder(const Vec& o, const Vec& d, double radius, double half_height) {
  LocalHit hit{-std::numeric_limits<double>::infinity(), Vec::Zero()};
  double leave = std::numeric_limits<double>::infinity();
  const double a = d.head<2>().squaredNorm(), c = o.head<2>().squaredNorm() - radius * radius;
  if (a > 0) {
    const double b = o.head<2>().dot(d.head<2>()), h = b * b - a * c;
    if (h < 0) return {};
    hit.t = (-b - std::sqrt(h)) / a;
    leave = (-b + std::sqrt(h)) / a;
    hit.normal.head<2>() = (o + hit.t * d).head<2>() / radius;
  } else if (c > 0) {
    return {};
  }
  if (d.z() != 0) {
    const double s = std::copysign(half_height, d.z()), near = (-s - o.z()) / d.z();
    if (near > hit.t) hit = {near, Vec(0, 0, d.z() > 0 ? -1 : 1)};
    leave = std::min(leave, (s - o.z()) / d.z());
  } else if (std::abs(o.z()) > half_height) {
    return {};
  }
  if (hit.t > leave || hit.t < 0) return {};
  return hit;
}

LocalHit hit_solid(const Solid& solid, const Vec& origin, const Vec& direction) {
  const Vec o = solid.R_world_local.transpose() * (origin - solid.center), d = solid.R_world_local.transpose() * direction;
  switch (solid.shape) {
    case Solid::Shape::box: return hit_box(o, d, solid.half);
    case Solid::Shape::cylinder: return hit_cylinder(o, d, solid.half.x(), solid.half.z());
    case Solid::Shape::sphere: return hit_sphere(o, d, solid.half.x());
  }
  return {};
}

/// Signed distance to a box, and in two dimensions to a cylinder's section, from the excess over the half sizes.
template <class V>
double outside_distance(const V& excess) {
  return excess.cwiseMax(0.0).norm() + std::min(excess.maxCoeff(), 0.0);
}

double signed_distance(const Solid& solid, const Vec& p_world) {
  const Vec p = solid.R_world_local.transpose() * (p_world - solid.center);
  switch (solid.shape) {
    case Solid::Shape::box: return outside_distance(Vec(p.cwiseAbs() - solid.half));
    case Solid::Shape::cylinder:
      return outside_distance(Eigen::Vector2d(p.head<2>().norm() - solid.half.x(), std::abs(p.z()) - solid.half.z()));
    case Solid::Shape::sphere: return p.norm() - solid.half.x();
  }
  return 0;
}

Eigen::AlignedBox3d world_box(const Solid& solid) {
  Vec half = solid.half;
  if (solid.shape == Solid::Shape::sphere) half = Vec::Constant(solid.half.x());
  if (solid.shape == Solid::Shape::cylinder) half.y() = solid.half.x();
  const Vec reach = solid.R_world_local.cwiseAbs() * half;
  return {solid.center - reach, solid.center + reach};
}

/// Whether the ray meets the box before `limit`. inverse: 1 / direction, infinite where that is 0.
bool meets(const Eigen::AlignedBox3d& box, const Vec& origin, const Vec& inverse, double limit) {
  double enter = 0, leave = limit;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.min()[k] - origin[k]) * inverse[k], b = (box.max()[k] - origin[k]) * inverse[k];
    enter = std::max(enter, std::min(a, b));  // a NaN (0 * infinity, the ray in the face's plane) leaves enter as it is
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

}  // namespace

void AnalyticScene::begin_object(std::string name, const Eigen::Isometry3d& T_world_object) {
  const auto n = static_cast<std::uint32_t>(solids_.size());
  objects_.push_back({std::move(name), T_world_object, n, n, {}});
}

void AnalyticScene::add(Solid::Shape shape, const Vec& center, const Vec& half, const Eigen::Vector3f& albedo,
                        const Eigen::Matrix3d& R_object_local) {
  PPM_CHECK(!objects_.empty(), "begin_object() comes first");
  Object& object = objects_.back();
  solids_.push_back({shape, object.T_world_object * center, object.T_world_object.linear() * R_object_local, half, albedo});
  object.box.extend(world_box(solids_.back()));
  object.end = static_cast<std::uint32_t>(solids_.size());
}

SceneHit AnalyticScene::cast(const Vec& origin, const Vec& direction) const {
  SceneHit best;
  const Vec inverse = direction.cwiseInverse();
  for (const Object& object : objects_) {
    if (!meets(object.box, origin, inverse, best.range_m)) continue;
    for (std::uint32_t i = object.first; i < object.end; ++i) {
      const LocalHit hit = hit_solid(solids_[i], origin, direction);
      if (hit.t < best.range_m) best = {hit.t, hit.normal, i};
    }
  }
  if (best.solid != SceneHit::kNone) best.normal = solids_[best.solid].R_world_local * best.normal;
  return best;
}

double AnalyticScene::distance(const Vec& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Solid& solid : solids_) least = std::min(least, signed_distance(solid, p));
  return least;
}

const std::string& AnalyticScene::object_name(std::uint32_t solid) const {
  PPM_CHECK(solid < solids_.size(), "solid {} of {}", solid, solids_.size());
  return std::find_if(objects_.begin(), objects_.end(), [&](const Object& o) { return solid < o.end; })->name;
}

}  // namespace ppm
