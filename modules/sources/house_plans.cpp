#include "modules/sources/house_plans.hpp"

#include "framework/core/error.hpp"

namespace ppm {
namespace {

constexpr double kEyes_m = 1.4;
constexpr double kRadian = EIGEN_PI / 180;

/// A waypoint at the height of the eyes; degrees.
Waypoint at(double x, double y, double yaw_deg, double pitch_deg = -12) {
  return {{x, y, kEyes_m}, yaw_deg * kRadian, pitch_deg * kRadian, {}, false};
}

Waypoint after(double seconds, Waypoint w) {
  w.seconds = seconds;
  return w;
}

Waypoint all_at_once(Waypoint w) {
  w.jump = true;
  return w;
}

std::vector<Waypoint> joined(std::vector<Waypoint> a, const std::vector<Waypoint>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<Waypoint> into_bedroom() {
  return {at(1.6, 0.3, 180), at(-0.8, 0.1, 180), at(-2.5, -0.5, 172), at(-4.4, -0.3, 160), at(-6.3, 0.0, 172)};
}

std::vector<Waypoint> round_the_screen() {
  return joined(into_bedroom(), {at(-7.9, -0.2, 205), at(-8.75, -1.2, 262), at(-8.4, -2.8, 305), at(-6.2, -3.4, 347),
                                 at(-4.0, -3.1, 373), at(-2.6, -1.9, 390)});
}

/// Where the way began, one full turn later.
std::vector<Waypoint> beginning_again() {
  return {at(1.6, 0.3, 540), at(-0.8, 0.1, 540), at(-2.2, -0.4, 532)};
}

std::vector<Waypoint> loop() {
  return joined(joined(round_the_screen(), {at(-1.4, -0.4, 385), at(0.4, 0.6, 400), at(2.2, 1.1, 465), at(2.7, 0.4, 525)}),
                beginning_again());
}

std::vector<Waypoint> tour() {
  const std::vector<Waypoint> living_room = {at(-1.6, -0.9, 350, -14), at(-1.7, -2.4, 290, -14), at(-1.4, -3.8, 320, -14),
                                             at(0.8, -3.9, 355, -14)};
  const std::vector<Waypoint> kitchen = {at(3.2, -3.6, 360),      at(5.6, -3.6, 365),       at(7.2, -3.3, 390, -14),
                                         at(7.0, -1.6, 450, -14), at(6.2, -0.8, 460, -14)};
  const std::vector<Waypoint> winter_garden = {at(4.8, -0.4, 410, -14), at(4.6, 0.9, 400, -14),  at(3.2, 1.2, 450, -14),
                                               at(1.4, 1.6, 455, -14),  at(-0.2, 2.6, 430, -14), at(-1.6, 2.7, 390, -14)};
  const std::vector<Waypoint> back = {at(-1.7, 1.2, 360, -14), at(-0.4, 0.6, 370, -14), at(1.2, 1.0, 440, -14),
                                      at(1.9, 0.5, 520, -14)};
  return joined(joined(joined(round_the_screen(), living_room), joined(kitchen, winter_garden)),
                joined(back, beginning_again()));
}

std::vector<Waypoint> corridor() {
  return {at(-3.4, -3.2, 178, -14), at(-4.2, -3.8, 190, -16),         at(-4.5, -4.2, 262, -46),
          at(-5.2, -4.3, 270, -48), after(2.5, at(-5.9, -4.3, 270, -48)), after(2.0, at(-6.2, -4.3, 270, -48)),
          at(-7.0, -4.25, 270, -48), at(-7.2, -4.0, 220, -25),        at(-7.0, -3.3, 190, -14),
          at(-6.0, -3.1, 180, -14), at(-4.6, -3.1, 178, -14)};
}

std::vector<Waypoint> fast_turn() {
  return {at(-1.6, 0.6, 10, -14),  at(0.2, 0.8, 20, -14),  at(1.6, 0.9, 35, -14),  after(0.7, at(1.9, 0.9, 195, -14)),
          at(1.2, 0.6, 205, -14),  at(-0.2, 0.4, 200, -14), at(-1.4, 0.2, 215, -14), at(-1.6, 0.6, 300, -14),
          at(-1.3, 0.8, 370, -14), at(0.2, 0.8, 378, -14)};
}

std::vector<Waypoint> kidnap() {
  return joined(into_bedroom(), {all_at_once(at(0.6, 0.5, 176, -14)), at(-0.8, 0.2, 180), at(-2.5, -0.4, 172),
                                 at(-3.6, -0.4, 165)});
}

}  // namespace

std::vector<Waypoint> house_plan(HousePlan plan) {
  switch (plan) {
    case HousePlan::loop:
      return loop();
    case HousePlan::tour:
      return tour();
    case HousePlan::corridor:
      return corridor();
    case HousePlan::fast_turn:
      return fast_turn();
    case HousePlan::kidnap:
      return kidnap();
  }
  PPM_CHECK(false, "plan {}", static_cast<int>(plan));
}

}  // namespace ppm
