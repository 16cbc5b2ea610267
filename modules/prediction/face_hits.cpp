#include "modules/prediction/face_hits.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {
namespace {

using Eigen::Vector3d;

/// A value that grows linearly along rows and columns: value(x, y) = (x, y, 1) . row.
double at(const Vector3d& row, double x, double y) {
  return row.x() * x + (row.y() * y + row.z());
}

/// A face as rays from one point meet it, after Möller and Trumbore 1997: u, v and depth of a pixel are ratios of values
/// that grow linearly over the image. In double precision, which needles and grazing faces need.
struct SeenFace {
  Vector3d e1 = Vector3d::Zero(), e2 = e1;  // m, edges from the first corner
  Vector3d from = e1;                       // m, from the first corner to the camera's centre
  Vector3d det = e1, u_det = e1, v_det = e1;
  double height = 0;    // m, of the centre over the face's plane, times twice the area
  double per_area = 0;  // 1/m^2, of twice the area

  SeenFace() = default;
  /// ray_of: pixel (x, y) looks along ray_of * (x, y, 1), map frame.
  SeenFace(const Geometry& g, std::uint32_t f, const Vector3d& centre, const Eigen::Matrix3d& ray_of) {
    const Vector3d p0 = g.position[g.face[f][0]].cast<double>();
    e1 = g.position[g.face[f][1]].cast<double>() - p0;
    e2 = g.position[g.face[f][2]].cast<double>() - p0;
    from = centre - p0;
    const Vector3d normal = e2.cross(e1), q = from.cross(e1);
    det = ray_of.transpose() * normal;
    u_det = ray_of.transpose() * e2.cross(from);
    v_det = ray_of.transpose() * q;
    height = e2.dot(q);
    per_area = 1 / std::sqrt(normal.squaredNorm());
  }

  /// The point of the face's border that a ray passes nearest by, measured across the ray.
  void pass_beside(const Vector3d& direction, double& u, double& v, double& range) const {
    const Vector3d corner[3] = {-from, e1 - from, e2 - from};  // from the centre
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
};

/// The hits of one view's pixels, in any order.
class HitFinder {
 public:
  HitFinder(const PpmMap& map, const FaceNumbers& faces, const Prediction& view, ElementHits& hits)
      : map_(map), faces_(faces), camera_(view.camera), hits_(hits), centre_(view.T_map_camera.translation()),
        per_fx_(1 / camera_.fx), per_fy_(1 / camera_.fy) {
    const Eigen::Matrix3d R = view.T_map_camera.linear();
    ray_of_.col(0) = R.col(0) / camera_.fx;
    ray_of_.col(1) = R.col(1) / camera_.fy;
    ray_of_.col(2) = R * camera_.ray(0, 0);
  }

  void find(int x, int y, std::uint32_t number) {
    if (number != last_) look_at(number);
    const auto p = static_cast<std::size_t>(y * camera_.cols + x);
    const double det = at(face_.det, x, y), per_det = 1 / det;
    const double rx = (x - camera_.cx) * per_fx_, ry = (y - camera_.cy) * per_fy_;
    const double length = std::sqrt(rx * rx + (ry * ry + 1));  // of the ray with unit depth
    double u = at(face_.u_det, x, y) * per_det, v = at(face_.v_det, x, y) * per_det,
           range = face_.height * per_det * length;
    if (!(u >= 0 && v >= 0 && u + v <= 1))
      face_.pass_beside(ray_of_ * Vector3d(x, y, 1) / length, u, v, range);
    hits_.u[p] = static_cast<float>(u);
    hits_.v[p] = static_cast<float>(v);
    hits_.range[p] = static_cast<float>(range);
    hits_.facing[p] = static_cast<float>(std::copysign(det * face_.per_area / length, face_.height));
    hits_.chunk[p] = chunk_;
    hits_.face[p] = last_ - faces_.first(chunk_);
  }

 private:
  void look_at(std::uint32_t number) {
    last_ = number;
    chunk_ = faces_.chunk_of(number, chunk_);
    face_ = SeenFace(*map_.table()[chunk_].geometry, number - faces_.first(chunk_), centre_, ray_of_);
  }

  const PpmMap& map_;
  const FaceNumbers& faces_;
  const Camera& camera_;
  ElementHits& hits_;
  Vector3d centre_;
  Eigen::Matrix3d ray_of_;
  double per_fx_, per_fy_;
  std::uint32_t last_ = FaceNumbers::kNone, chunk_ = 0;  // of face_: neighbouring pixels often show the same
  SeenFace face_;
};

}  // namespace

void hits_of_faces(const PpmMap& map, const FaceNumbers& faces, std::span<const std::uint32_t> number, const Rows& rows,
                   const Prediction& view, ElementHits& hits) {
  HitFinder finder(map, faces, view, hits);
  const std::uint32_t* next = number.data() + static_cast<std::ptrdiff_t>(rows.first) * view.camera.cols;
  for (int y = rows.first; y < rows.end; ++y)
    for (int x = 0; x < view.camera.cols; ++x, ++next)
      if (*next != FaceNumbers::kNone) finder.find(x, y, *next);
}

}  // namespace ppm
