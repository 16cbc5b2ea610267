#include "modules/maps/picture/overview.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "framework/core/timing.hpp"

namespace ppm {
namespace {

/// Calls f(area-weighted normal) for each face.
template <class F>
void for_each_normal(const Mesh& mesh, F f) {
  auto corner = [&](std::uint32_t v) -> Eigen::Vector3d { return mesh.position[v].cast<double>(); };
  for (const auto& face : mesh.face) {
    const Eigen::Vector3d p = corner(face[0]), q = corner(face[1]), r = corner(face[2]);
    f(Eigen::Vector3d((q - p).cross(r - p)));
  }
}

/// Two horizontal axes along the walls: the direction that repeats every 90 degrees and fits the vertical faces best.
std::pair<Eigen::Vector3d, Eigen::Vector3d> wall_axes(const Mesh& mesh, const Eigen::Vector3d& up) {
  const Eigen::Vector3d e1 = up.unitOrthogonal(), e2 = up.cross(e1);
  std::complex<double> sum = 0;
  for_each_normal(mesh, [&](const Eigen::Vector3d& n) {
    const std::complex<double> horizontal(n.dot(e1), n.dot(e2));
    if (std::abs(n.dot(up)) < 0.3 * n.norm()) sum += std::abs(horizontal) * std::polar(1.0, 4 * std::arg(horizontal));
  });
  const double angle = std::arg(sum) / 4;
  return {std::cos(angle) * e1 + std::sin(angle) * e2, -std::sin(angle) * e1 + std::cos(angle) * e2};
}

double area_facing(const Mesh& mesh, const Eigen::Vector3d& towards) {
  double sum = 0;
  for_each_normal(mesh, [&](const Eigen::Vector3d& n) { sum += std::max(0.0, n.dot(towards)); });
  return sum;
}

/// A point to be in the picture, in the axes of the camera, and how much surface it stands for.
struct Subject {
  Eigen::Vector3d p;
  double weight;
};

/// What is to be seen: the corners of the faces that are turned towards the eye, and the path, which counts for a
/// tenth.
std::vector<Subject> subjects_of(const Mesh& mesh, const std::vector<Pose>& path, const Eigen::Vector3d& towards,
                                 const Eigen::Matrix3d& axes) {
  std::vector<Subject> subjects;
  double total = 0;
  std::size_t face = 0;
  for_each_normal(mesh, [&](const Eigen::Vector3d& n) {
    const auto& corners = mesh.face[face++];
    if (n.dot(towards) <= 0) return;
    total += n.norm();
    for (auto v : corners) subjects.push_back({axes.transpose() * mesh.position[v].cast<double>(), n.norm() / 3});
  });
  const double share = (total > 0 ? 0.1 * total : 1.0) / static_cast<double>(std::max<std::size_t>(path.size(), 1));
  for (const auto& T : path) subjects.push_back({axes.transpose() * T.translation(), share});
  return subjects;
}

/// The range of a coordinate (first) without the outermost half thousandth of the weight (second) at each end.
std::pair<double, double> robust_range(std::vector<std::pair<double, double>> values) {
  std::sort(values.begin(), values.end());
  double total = 0;
  for (const auto& v : values) total += v.second;
  auto low = values.begin(), high = values.end() - 1;
  for (double left = total / 2000; (left -= low->second) > 0 && low != high;) ++low;
  for (double left = total / 2000; (left -= high->second) > 0 && high != low;) --high;
  return {low->first, high->first};
}

/// Shifts the eye sideways, so that the subjects lie in the middle of the picture, to first order.
void centre(const std::vector<Subject>& subjects, Eigen::Vector3d& eye) {
  std::array<std::vector<std::pair<double, double>>, 2> slope;
  std::vector<double> depths;
  for (const auto& subject : subjects) {
    const Eigen::Vector3d q = subject.p - eye;
    if (q.z() <= 0) continue;
    depths.push_back(q.z());
    for (int axis = 0; axis < 2; ++axis)
      slope[static_cast<std::size_t>(axis)].push_back({q[axis] / q.z(), subject.weight});
  }
  if (depths.empty()) return;
  const double depth = quantile(depths, 0.5);
  for (int axis = 0; axis < 2; ++axis) {
    const auto [low, high] = robust_range(slope[static_cast<std::size_t>(axis)]);
    eye[axis] += 0.5 * (low + high) * depth;
  }
}

/// Places the eye, in the axes of the camera, so that nearly all subjects fill the picture.
Eigen::Vector3d fit(const std::vector<Subject>& subjects, const Camera& camera) {
  // A point is inside the left border if x + s z >= x0 + s z0, with s the border's slope: each border is an extreme
  // value.
  auto place = [&](int axis, double slope) {
    std::vector<std::pair<double, double>> low, high;
    for (const auto& subject : subjects) {
      low.push_back({subject.p[axis] + slope * subject.p.z(), subject.weight});
      high.push_back({subject.p[axis] - slope * subject.p.z(), subject.weight});
    }
    const double least = robust_range(low).first, most = robust_range(high).second;
    return std::pair{(least + most) / 2, (least - most) / (2 * slope)};  // the eye's coordinate, its depth
  };
  constexpr double kMargin = 0.94;
  const auto [x, z_for_x] = place(0, kMargin * camera.cols / (2 * camera.fx));
  const auto [y, z_for_y] = place(1, kMargin * camera.rows / (2 * camera.fy));
  Eigen::Vector3d eye(x, y, std::min(z_for_x, z_for_y));
  for (int i = 0; i < 4; ++i) centre(subjects, eye);
  return eye;
}

}  // namespace

Eigen::Vector3d estimate_up(const Mesh& mesh, const std::vector<Pose>& path) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const auto& T : path) up -= T.linear().col(1);
  if (up.norm() < 1e-6) return Eigen::Vector3d::UnitZ();
  up.normalize();
  for (const double degrees : {45.0, 25.0, 12.0, 6.0}) {
    const double least = std::cos(degrees * std::numbers::pi / 180);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for_each_normal(mesh, [&](const Eigen::Vector3d& n) {
      const double along = n.dot(up);
      if (std::abs(along) > least * n.norm()) sum += along > 0 ? n : Eigen::Vector3d(-n);
    });
    if (sum.norm() > 0) up = sum.normalized();
  }
  return up;
}

View overview(const Mesh& mesh, const std::vector<Pose>& path, const Eigen::Vector3d& up, double azimuth_rad,
              double elevation_rad, int cols, int rows) {
  const auto [e1, e2] = wall_axes(mesh, up);
  Eigen::Vector3d towards = up;  // from the map to the eye
  double best = -1;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double angle = azimuth_rad + quarter * std::numbers::pi / 2;
    const Eigen::Vector3d d =
        std::cos(elevation_rad) * (std::cos(angle) * e1 + std::sin(angle) * e2) + std::sin(elevation_rad) * up;
    const double area = area_facing(mesh, d);
    if (area > best * (1 + 1e-9)) {
      best = area;
      towards = d;
    }
  }
  const Eigen::Vector3d forward = -towards;
  const Eigen::Vector3d horizontal = forward.cross(up);
  const Eigen::Vector3d right = horizontal.norm() > 1e-6 ? horizontal.normalized() : e1;
  Eigen::Matrix3d axes;
  axes << right, forward.cross(right), forward;

  View view;
  const double focal = 1.5 * std::max(cols, rows);
  view.camera = {cols, rows, focal, focal, (cols - 1) / 2.0, (rows - 1) / 2.0};
  const auto subjects = subjects_of(mesh, path, towards, axes);
  Eigen::Vector3d eye(0, 0, -1);
  if (!subjects.empty()) eye = fit(subjects, view.camera);
  if (mesh.position.empty()) eye.z() -= 1;  // a path alone may be a point
  view.T_map_camera.linear() = axes;
  view.T_map_camera.translation() = axes * eye;
  return view;
}

}  // namespace ppm
