#include "modules/prediction/face_hits.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {

using Eigen::Vector3d;

namespace {

/// A value that grows linearly along rows and columns: row . (x, y, 1).
double at_pixel(const Vector3d& row, double x, double y) {
  return row.x() * x + (row.y() * y + row.z());
}

}  // namespace

SeenFace::SeenFace(const Geometry& geometry, std::uint32_t face, const Vector3d& centre,
                   const Eigen::Matrix3d& ray_of) {
  const auto& corner = geometry.face[face];
  const Vector3d p0 = geometry.position[corner[0]].cast<double>();
  e1_ = geometry.position[corner[1]].cast<double>() - p0;
  e2_ = geometry.position[corner[2]].cast<double>() - p0;
  from_ = centre - p0;
  const Vector3d into = e2_.cross(e1_), q = from_.cross(e1_);
  det_ = ray_of.transpose() * into;
  u_det_ = ray_of.transpose() * e2_.cross(from_);
  v_det_ = ray_of.transpose() * q;
  height_ = e2_.dot(q);
  per_area_ = 1 / std::sqrt(into.squaredNorm());
}

void SeenFace::meet(int x, int y, const Eigen::Matrix3d& ray_of, double length, ElementHits& hits,
                    std::size_t at) const {
  const double det = at_pixel(det_, x, y), per_det = 1 / det;
  double u = at_pixel(u_det_, x, y) * per_det, v = at_pixel(v_det_, x, y) * per_det, range = height_ * per_det * length;
  if (!(u >= 0 && v >= 0 && u + v <= 1)) pass_beside(ray_of * Vector3d(x, y, 1) / length, u, v, range);
  hits.u[at] = static_cast<float>(u);
  hits.v[at] = static_cast<float>(v);
  hits.range[at] = static_cast<float>(range);
  hits.facing[at] = static_cast<float>(std::copysign(det * per_area_ / length, height_));
}

// The point of the border that the ray passes nearest by, measured across the ray.
void SeenFace::pass_beside(const Vector3d& direction, double& u, double& v, double& range) const {
  const Vector3d corner[3] = {-from_, e1_ - from_, e2_ - from_};  // from the centre
  double least = INFINITY;
  for (int i = 0; i < 3; ++i) {
    const Vector3d &a = corner[i], edge = corner[(i + 1) % 3] - a;
    const Vector3d a_across = a - a.dot(direction) * direction, across = edge - edge.dot(direction) * direction;
    const double length = across.squaredNorm();
    const double s = length > 0 ? std::clamp(-a_across.dot(across) / length, 0.0, 1.0) : 0.0;
    const double distance = (a_across + s * across).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    range = (a + s * edge).dot(direction);
    u = i == 0 ? s : i == 1 ? 1 - s : 0;
    v = i == 0 ? 0 : i == 1 ? s : 1 - s;
  }
}

HitFinder::HitFinder(const PpmMap& map, const FaceNumbers& faces, const Prediction& view)
    : map_(map),
      faces_(faces),
      camera_(view.camera),
      centre_(view.T_map_camera.translation()),
      per_fx_(1 / camera_.fx),
      per_fy_(1 / camera_.fy) {
  const Eigen::Matrix3d R = view.T_map_camera.linear();
  ray_of_.col(0) = R.col(0) / camera_.fx;
  ray_of_.col(1) = R.col(1) / camera_.fy;
  ray_of_.col(2) = R * camera_.ray(0, 0);
}

void HitFinder::find(int x, int y, std::uint32_t number, ElementHits& hits, std::size_t at) {
  if (number == FaceNumbers::kNone) {
    hits.chunk[at] = Prediction::kNone;
    return;
  }
  if (number != last_) look_at(number);
  const double ray_x = (x - camera_.cx) * per_fx_, ray_y = (y - camera_.cy) * per_fy_;
  seen_.meet(x, y, ray_of_, std::sqrt(ray_x * ray_x + (ray_y * ray_y + 1)), hits, at);
  hits.chunk[at] = chunk_;
  hits.face[at] = face_;
}

void HitFinder::look_at(std::uint32_t number) {
  last_ = number;
  chunk_ = faces_.chunk_of(number, chunk_);
  face_ = number - faces_.first(chunk_);
  seen_ = SeenFace(*map_.table()[chunk_].geometry, face_, centre_, ray_of_);
}

}  // namespace ppm
