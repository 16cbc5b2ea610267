#include "modules/sources/camera_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/core/error.hpp"
#include "modules/sources/view_direction.hpp"

namespace ppm {
namespace {

constexpr double kLeastStep_s = 0.1;  // between waypoints that ask for no movement
constexpr int kYaw = 3, kPitch = 4, kRoll = 5;

/// One swing of the hand: amplitude * sin(rate * t + phase) of x, y, z (m), yaw, pitch, roll (rad).
struct Swing {
  int channel;
  double amplitude, rate, phase;
};
constexpr std::array<Swing, 9> kSway{{{0, 0.010, 2.9, 0.0},
                                      {1, 0.010, 3.7, 1.0},
                                      {2, 0.012, 4.1, 0.4},
                                      {kYaw, 0.020, 1.9, 0.0},
                                      {kYaw, 0.006, 5.3, 2.0},
                                      {kPitch, 0.012, 2.7, 0.7},
                                      {kPitch, 0.004, 6.1, 1.3},
                                      {kRoll, 0.030, 1.1, 0.0},
                                      {kRoll, 0.010, 3.3, 0.5}}};

using State = Eigen::Matrix<double, 6, 3>;  // x, y, z, yaw, pitch, roll; value, first and second derivative

void add_sway(double scale, double t, State& state) {
  for (const Swing& s : kSway) {
    const double a = scale * s.amplitude, phase = s.rate * t + s.phase;
    state(s.channel, 0) += a * std::sin(phase);
    state(s.channel, 1) += a * s.rate * std::cos(phase);
    state(s.channel, 2) -= a * s.rate * s.rate * std::sin(phase);
  }
}

/// Angular velocity about the camera's axes: the yaw's is about the world's z axis, the pitch's about the level axis to the
/// right, the roll's about the optical axis.
Eigen::Vector3d angular_velocity(const State& s) {
  const double pitch = s(kPitch, 0);
  const Eigen::Vector3d level = s(kYaw, 1) * Eigen::Vector3d(0, -std::cos(pitch), std::sin(pitch)) +
                                s(kPitch, 1) * Eigen::Vector3d::UnitX();
  return Eigen::AngleAxisd(-s(kRoll, 0), Eigen::Vector3d::UnitZ()) * level + s(kRoll, 1) * Eigen::Vector3d::UnitZ();
}

double seconds_between(const Waypoint& a, const Waypoint& b, const Gait& gait) {
  if (b.seconds) return *b.seconds;
  const double turn = std::hypot(b.yaw - a.yaw, b.pitch - a.pitch);
  return std::max({kLeastStep_s, (b.position - a.position).norm() / gait.speed, turn / gait.turning});
}

}  // namespace

CameraPath::CameraPath(const std::vector<Waypoint>& waypoints, const Gait& gait) : sway_(gait.sway) {
  PPM_CHECK(waypoints.size() >= 2, "a path of {} waypoints", waypoints.size());
  double t = 0;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Waypoint& w = waypoints[i];
    if (i == 0 || w.jump)
      pieces_.emplace_back();
    else
      t += seconds_between(waypoints[i - 1], w, gait);
    Knot knot{t, Channels::Zero(), Channels::Zero()};
    knot.value << w.position, w.yaw, w.pitch;
    pieces_.back().push_back(knot);
  }
  for (Piece& piece : pieces_) {
    PPM_CHECK(piece.size() >= 2, "a part of a path with one waypoint");
    set_slopes(piece);
  }
}

void CameraPath::set_slopes(Piece& piece) {
  for (std::size_t i = 1; i + 1 < piece.size(); ++i) {
    const double before_s = piece[i].t_s - piece[i - 1].t_s, after_s = piece[i + 1].t_s - piece[i].t_s;
    const Channels before = (piece[i].value - piece[i - 1].value) / before_s;
    const Channels after = (piece[i + 1].value - piece[i].value) / after_s;
    piece[i].slope = (after_s * before + before_s * after) / (before_s + after_s);
    for (const int k : {kYaw, kPitch}) {
      const double w = (2 * after_s + before_s) / (3 * (before_s + after_s));
      piece[i].slope[k] = before[k] * after[k] > 0 ? 1 / (w / before[k] + (1 - w) / after[k]) : 0;
    }
  }
}

double CameraPath::duration_s() const {
  return pieces_.back().back().t_s;
}

std::vector<double> CameraPath::jumps_s() const {
  std::vector<double> times;
  for (std::size_t i = 1; i < pieces_.size(); ++i) times.push_back(pieces_[i].front().t_s);
  return times;
}

CameraMotion CameraPath::at(double t_s) const {
  const auto later = [](double t, const Piece& p) { return t < p.front().t_s; };
  auto next_piece = std::upper_bound(pieces_.begin(), pieces_.end(), t_s, later);
  const Piece& piece = next_piece == pieces_.begin() ? *next_piece : *(next_piece - 1);
  const double t = std::clamp(t_s, piece.front().t_s, piece.back().t_s);
  const auto after = [](double time, const Knot& k) { return time < k.t_s; };
  const auto b = std::min(std::upper_bound(piece.begin() + 1, piece.end(), t, after), piece.end() - 1);
  const auto a = b - 1;

  const double h = b->t_s - a->t_s, s = (t - a->t_s) / h;
  const Channels step = b->value - a->value, from = a->slope * h, to = b->slope * h;
  const Channels c3 = 10 * step - 6 * from - 4 * to, c4 = -15 * step + 8 * from + 7 * to, c5 = 6 * step - 3 * from - 3 * to;
  State state = State::Zero();
  state.topRows<5>() << a->value + s * (from + s * s * (c3 + s * (c4 + s * c5))),
      (from + s * s * (3 * c3 + s * (4 * c4 + s * 5 * c5))) / h, s * (6 * c3 + s * (12 * c4 + s * 20 * c5)) / (h * h);
  add_sway(sway_, t_s, state);

  CameraMotion motion;
  motion.T_world_camera.linear() = camera_axes(state(kYaw, 0), state(kPitch, 0), state(kRoll, 0));
  motion.T_world_camera.translation() = state.block<3, 1>(0, 0);
  motion.velocity_world = state.block<3, 1>(0, 1);
  motion.acceleration_world = state.block<3, 1>(0, 2);
  motion.angular_velocity = angular_velocity(state);
  return motion;
}

}  // namespace ppm
