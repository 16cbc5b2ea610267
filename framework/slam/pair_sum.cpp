#include "framework/slam/pair_sum.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "framework/core/error.hpp"
#include "framework/core/se3.hpp"

namespace ppm {
namespace {

constexpr std::size_t kEvery = 4;          // residual is kept for statistics
constexpr Eigen::Index kMost = 12 + kMostCameraParameters;
using ByCamera = Eigen::Matrix<double, kMostCameraParameters, 1>;
using Row = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMost, kMost>;

/// Steps of the numeric derivatives: 1e-4 of the focal length, of a pixel, of 1/m.
constexpr double kStep = 1e-4;

/// Points of one frame on planes of another.
class Half {
 public:
  Half(const PlacedFrame& from, const PlacedFrame& to, const Pose& T_to_from, Eigen::Index parameters,
       const PairGate& gate)
      : from_(from), to_(to), T_(T_to_from), parameters_(parameters), gate_(gate) {}

  /// Calls f(r, weight, J_from, J_to, J_parameters) for each point within the gates of distance and normal.
  template <class F>
  void each(F f) const {
    for (std::size_t i = 0; i < from_.placed.size(); ++i) {
      const PlacedPatch& patch = from_.placed[i];
      const Eigen::Vector3d q = T_ * patch.point;
      if (!(q.z() > 0)) continue;
      const Eigen::Vector2d pixel = to_.camera.project(q);
      const int on = to_.patches->around(pixel.x(), pixel.y());
      if (on < 0) continue;
      const auto k = static_cast<std::size_t>(on);
      const Eigen::Vector3d& plane = to_.placed[k].plane;
      const double length = plane.norm(), r = (plane.dot(q) - 1) / length;
      if (!(std::abs(r) < gate_.distance_m)) continue;
      const Eigen::Vector3d n = plane / length, turned = T_.linear() * patch.plane;
      if (n.dot(turned) < gate_.normal_cosine * turned.norm()) continue;
      // An error of either's depth moves the point along its ray, which meets the plane at the depth 1 / (length cosine).
      const double sigma = std::hypot(patch.sigma, to_.placed[k].sigma) / (length * q.z());
      Twist by_from, by_to;
      const Eigen::Vector3d n_from = T_.linear().transpose() * n;
      by_from << n_from, patch.point.cross(n_from);
      by_to << -n, -q.cross(n);
      f(r, 1 / (sigma * sigma), by_from, by_to, by_parameters(i, k, q, n, length, r));
    }
  }

 private:
  /// Of r / sigma, times sigma. sigma counts: a camera that shrinks the world shrinks its errors too, and must gain nothing by it.
  ByCamera by_parameters(std::size_t i, std::size_t k, const Eigen::Vector3d& q, const Eigen::Vector3d& n,
                                double length, double r) const {
    ByCamera out = ByCamera::Zero();
    const double s = from_.placed[i].sigma, t = to_.placed[k].sigma;
    const auto count = static_cast<std::size_t>(parameters_);
    for (std::size_t p = 0; p < count; ++p) {
      const PlacedPatch& from = from_.change[i * count + p];
      const PlacedPatch& to = to_.change[k * count + p];
      const Eigen::Vector3d moved = T_.linear() * from.point;
      const double stretched = n.dot(to.plane) / length;
      const double noise = (s * from.sigma + t * to.sigma) / (s * s + t * t) - stretched - moved.z() / q.z();
      out[static_cast<Eigen::Index>(p)] = n.dot(moved) + to.plane.dot(q) / length - r * (stretched + noise);
    }
    return out;
  }

  const PlacedFrame& from_;
  const PlacedFrame& to_;
  Pose T_;
  Eigen::Index parameters_;
  const PairGate& gate_;
};

}  // namespace

PlacedFrame::PlacedFrame(const SurfacePatches& of, const CameraCorrection& correction, const CameraParameters& parameters)
    : patches(&of), camera(correction.camera(of.camera)) {
  PPM_CHECK(parameters.size() <= kMostCameraParameters, "{} parameters of a camera", parameters.size());
  std::vector<std::array<CameraCorrection, 2>> beside;
  for (Eigen::Index p = 0; p < parameters.size(); ++p) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(parameters.size(), p);
    beside.push_back({parameters.moved(correction, -step), parameters.moved(correction, step)});
  }
  for (const auto& patch : of.all) {
    placed.push_back(ppm::placed(patch, of.camera, correction));
    for (const auto& [before, after] : beside) {
      const PlacedPatch a = ppm::placed(patch, of.camera, before), b = ppm::placed(patch, of.camera, after);
      change.push_back({(b.point - a.point) / (2 * kStep), (b.plane - a.plane) / (2 * kStep),
                        (b.sigma - a.sigma) / (2 * kStep)});
    }
  }
}

PairSum sum_pair(const PlacedFrame& first, const Pose& T_world_first, const PlacedFrame& second,
                 const Pose& T_world_second, const PairGate& gate) {
  const Eigen::Index parameters =
      first.placed.empty() ? 0 : static_cast<Eigen::Index>(first.change.size() / first.placed.size());
  PairSum sum;
  Square H = Square::Zero(12 + parameters, 12 + parameters);
  Row b = Row::Zero(12 + parameters), J(12 + parameters);
  std::size_t compared = 0;
  auto add = [&](const Half& half, bool forth) {
    half.each([&](double r, double weight, const Twist& by_from, const Twist& by_to, const ByCamera& by_camera) {
      const double deviation = std::abs(r) * std::sqrt(weight);
      if (compared++ % kEvery == 0) {
        sum.deviation.push_back(static_cast<float>(deviation));
        sum.distance_m.push_back(static_cast<float>(std::abs(r)));
      }
      if (deviation > gate.deviations) return;
      J.head<6>() = forth ? by_from : by_to;
      J.segment<6>(6) = forth ? by_to : by_from;
      J.tail(parameters) = by_camera.head(parameters);
      H.selfadjointView<Eigen::Lower>().rankUpdate(J, weight);
      b -= weight * r * J;
      sum.square += weight * r * r;
      ++sum.points;
    });
  };
  const Pose T_second_first = T_world_second.inverse() * T_world_first;
  add({first, second, T_second_first, parameters, gate}, true);
  add({second, first, T_second_first.inverse(), parameters, gate}, false);
  sum.H = H.selfadjointView<Eigen::Lower>();
  sum.b = b;
  return sum;
}

}  // namespace ppm
