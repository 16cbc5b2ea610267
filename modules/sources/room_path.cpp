#include "modules/sources/room_path.hpp"

#include <cmath>

#include "modules/sources/view_direction.hpp"

namespace ppm {
namespace {

constexpr double kLoop_s = 24, kStart_s = 0.7;  // one loop; time constant of setting off
constexpr double kRadiusX_m = 0.95, kRadiusY_m = 0.80, kHeight_m = 1.42;

}  // namespace

Pose room_camera_pose(double t_s) {
  const double u = t_s - kStart_s * (1 - std::exp(-t_s / kStart_s));  // time since a start at full speed
  const double angle = 0.6 + 2 * EIGEN_PI * u / kLoop_s;
  Pose T = Pose::Identity();
  T.translation() << kRadiusX_m * std::cos(angle) + 0.010 * std::sin(2.9 * u),
      kRadiusY_m * std::sin(angle) + 0.010 * std::sin(3.7 * u + 1.0),
      kHeight_m + 0.06 * std::sin(0.9 * u + 0.4) + 0.012 * std::sin(4.1 * u);
  const double yaw = angle + EIGEN_PI + 0.020 * std::sin(1.9 * u);
  const double pitch = -0.36 + 0.18 * std::sin(0.8 * u + 0.7) + 0.012 * std::sin(2.7 * u);
  const double roll = 0.035 * std::sin(1.1 * u) + 0.010 * std::sin(3.3 * u);
  T.linear() = camera_axes(yaw, pitch, roll);
  return T;
}

}  // namespace ppm
