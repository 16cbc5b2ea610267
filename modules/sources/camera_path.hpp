#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "framework/core/se3.hpp"

namespace ppm {

/// Where a camera is to be, and how it looks. World frame: z up, metres.
struct Waypoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /// Direction of view, rad: yaw about the world's z axis from +x towards +y, pitch up from the horizon. Angles are numbers
  /// on a line: from 3.0 to 3.3 is a small turn, from 3.0 to -3.0 nearly a full one.
  double yaw = 0, pitch = 0;
  std::optional<double> seconds;  ///< since the waypoint before, > 0; else as speed and turning demand
  bool jump = false;              ///< the camera is here all at once, at the time of the waypoint before
};

/// How fast a camera is carried along waypoints, and how steadily.
struct Gait {
  double speed = 0.5;      ///< m/s
  double turning = 0.7;    ///< rad/s; of position and direction, the slower one sets the time between two waypoints
  double sway = 1;         ///< scale of the movement of the hand (kSway in camera_path.cpp); 0 = none
};

/// How a camera moves at an instant.
struct CameraMotion {
  Pose T_world_camera = Pose::Identity();
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();      ///< m/s
  Eigen::Vector3d acceleration_world = Eigen::Vector3d::Zero();  ///< m/s^2
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();    ///< rad/s, about the camera's own axes
};

/// A smooth path through waypoints: position, yaw and pitch are splines in time, twice differentiable, at rest at both ends
/// (and on both sides of a jump); on them lies the sway of a hand, a sum of sines. Its derivatives are exact.
/// Quintic pieces with zero curvature at the waypoints; slopes of positions are those of the parabola through three
/// waypoints, slopes of angles are limited so that a fast turn hardly overshoots (Fritsch & Butland, SIAM J. Sci. Stat. Comput.
/// 5(2), 1984).
class CameraPath {
 public:
  /// At least two waypoints; none but the first after a jump alone. Throws InternalError otherwise.
  CameraPath(const std::vector<Waypoint>& waypoints, const Gait& gait);
  double duration_s() const;
  /// At t_s in [0, duration_s()]; times outside are moved to the nearer end, but for the sway.
  CameraMotion at(double t_s) const;
  /// The times of jumps, s, ascending: from there on the camera is where it jumped to.
  std::vector<double> jumps_s() const;

 private:
  using Channels = Eigen::Matrix<double, 5, 1>;  // x, y, z, yaw, pitch
  struct Knot {
    double t_s;
    Channels value, slope;
  };
  using Piece = std::vector<Knot>;
  static void set_slopes(Piece& piece);

  double sway_;
  std::vector<Piece> pieces_;
};

}  // namespace ppm
