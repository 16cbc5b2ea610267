#include "modules/sources/house_plans.hpp"

#include "framework/core/error.hpp"

namespace ppm {
namespace {

constexpr double kEyes_m = 1.4;

/// A waypoint at the height of the eyes, degrees.
Waypoint at(double x, double y, double yaw_deg, double pitch_deg = -12) {
  constexpr double kRadian = EIGEN_PI / 180;
  return {{x, y, kEyes_m}, yaw_deg * kRadian, pitch_deg * kRadian, {}, false};
}

std::vector<Waypoint> loop() {
  return {at(1.6, 0.3, 180),    at(-0.8, 0.1, 180),   at(-2.5, -0.5, 172),  at(-4.4, -0.3, 160),
          at(-6.3, 0.0, 172),   at(-7.9, -0.2, 205),  at(-8.75, -1.2, 262), at(-8.4, -2.8, 305),
          at(-6.2, -3.4, 347),  at(-4.0, -3.1, 373),  at(-2.6, -1.9, 390),  at(-1.4, -0.4, 385),
          at(0.4, 0.6, 400),    at(2.2, 1.1, 465),    at(2.7, 0.4, 525),    at(1.6, 0.3, 540),
          at(-0.8, 0.1, 540),   at(-2.2, -0.4, 532)};
}

}  // namespace

std::vector<Waypoint> house_plan(HousePlan plan) {
  switch (plan) {
    case HousePlan::loop:
      return loop();
  }
  PPM_CHECK(false, "plan {}", static_cast<int>(plan));
}

}  // namespace ppm
