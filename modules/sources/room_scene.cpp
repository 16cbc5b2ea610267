#include "modules/sources/room_scene.hpp"

#include <limits>

#include "modules/sources/room_furniture.hpp"
#include "modules/sources/room_parts.hpp"

namespace ppm {

using namespace parts;

namespace {

constexpr double kThick = 0.1;  // of walls, floor and ceiling
constexpr double kEndless = std::numeric_limits<double>::infinity();

void add_shell(SceneBuilder& s) {
  const Vec h = kRoomHalf;
  const double height = 2 * h.z();
  const Color paint(0.78f, 0.76f, 0.70f), accent(0.50f, 0.60f, 0.56f);
  s.begin_object("floor");
  box(s, {0, 0, -kThick / 2}, {2 * h.x() + 2 * kThick, 2 * h.y() + 2 * kThick, kThick}, {0.52f, 0.40f, 0.28f});
  s.paint({{1.10, 0.16, kEndless}, {0.44f, 0.33f, 0.22f}});  // boards
  s.begin_object("ceiling");
  box(s, {0, 0, height + kThick / 2}, {2 * h.x() + 2 * kThick, 2 * h.y() + 2 * kThick, kThick}, kWhite);
  s.begin_object("east wall");
  box(s, {h.x() + kThick / 2, 0, h.z()}, {kThick, 2 * h.y(), height}, paint);
  s.begin_object("west wall");
  box(s, {-h.x() - kThick / 2, 0, h.z()}, {kThick, 2 * h.y(), height}, paint);
  s.begin_object("north wall");
  box(s, {0, h.y() + kThick / 2, h.z()}, {2 * h.x(), kThick, height}, accent);
  s.paint({{0.30, kEndless, kEndless}, {0.55f, 0.65f, 0.60f}});  // wallpaper in stripes
  s.begin_object("south wall");
  box(s, {0, -h.y() - kThick / 2, h.z()}, {2 * h.x(), kThick, height}, paint);
  s.begin_object("skirting boards");
  for (double side : {-1.0, 1.0}) {
    box(s, {side * (h.x() - 0.01), 0, 0.045}, {0.02, 2 * h.y(), 0.09}, kWhite);
    box(s, {0, side * (h.y() - 0.01), 0.045}, {2 * h.x(), 0.02, 0.09}, kWhite);
  }
}

void add_small_things(SceneBuilder& s) {
  s.begin_object("rug", at(0.0, 0.75, 0, 0));
  box(s, {0, 0, 0.006}, {2.6, 1.7, 0.012}, kRed * 0.9f);
  box(s, {0, 0, 0.007}, {2.3, 1.4, 0.014}, kCream);
  s.paint({{0.115, 0.10, kEndless}, kCream * 0.8f});
  for (double x : {-0.8, 0.0, 0.8}) box(s, {x, 0, 0.008}, {0.45, 0.45, 0.016}, kBlue, yaw(45));
  s.begin_object("ceiling lamp", at(0, 0.3, 0, 0));
  cylinder(s, {0, 0, 2.56}, 0.22, 0.08, kCream);
  s.begin_object("pendant lamp", at(0.9, -1.42, 0, 0));
  cylinder(s, {0, 0, 2.25}, 0.008, 0.7, kBlack);
  sphere(s, {0, 0, 1.80}, 0.15, kYellow);
  s.begin_object("wall clock", at(-2.8, -0.35, 1.75, 0));
  cylinder(s, {0.02, 0, 0}, 0.17, 0.04, kWhite, tilt(90));
  cylinder(s, {0.025, 0, 0}, 0.02, 0.05, kBlack, tilt(90));
  s.begin_object("boxes", at(-1.6, -1.95, 0, 8));
  box(s, {0, 0, 0.18}, {0.50, 0.40, 0.36}, {0.66f, 0.52f, 0.36f});
  box(s, {0.03, 0.02, 0.47}, {0.36, 0.30, 0.22}, {0.70f, 0.56f, 0.40f}, yaw(22));
  s.begin_object("waste bin", at(2.55, -0.95, 0, 0));
  cylinder(s, {0, 0, 0.16}, 0.14, 0.32, kSteel);
  s.begin_object("basket", at(-2.45, -0.45, 0, 0));
  cylinder(s, {0, 0, 0.20}, 0.20, 0.40, kOak);
  cylinder(s, {0.05, 0.02, 0.42}, 0.13, 0.10, kCream);
  s.begin_object("toy blocks", at(-1.65, -0.15, 0, 15));
  box(s, {0, 0, 0.10}, {0.20, 0.20, 0.20}, kBlue);
  box(s, {0.16, 0.18, 0.075}, {0.15, 0.15, 0.15}, kYellow, yaw(30));
  box(s, {0.02, 0.01, 0.27}, {0.14, 0.14, 0.14}, kRed, yaw(20));
  s.begin_object("pouffe", at(1.35, 0.75, 0, 0));
  cylinder(s, {0, 0, 0.20}, 0.26, 0.40, kTerracotta);
}

}  // namespace

AnalyticScene make_room() {
  SceneBuilder s;
  add_shell(s);
  add_small_things(s);
  add_sofa(s, at(0.0, 1.80, 0, -90));
  add_picture(s, at(-0.35, 2.3, 1.60, -90), 1.0, 0.65);
  add_picture(s, at(0.65, 2.3, 1.52, -90), 0.45, 0.55);
  add_coffee_table(s, at(0.0, 0.85, 0, -86));
  add_armchair(s, at(2.05, 1.55, 0, -140));
  add_floor_lamp(s, at(1.45, 2.02, 0, 0));
  add_bookshelf(s, at(2.63, -0.05, 0, 180));
  add_dining_table(s, at(0.9, -1.42, 0, 90));
  add_chair(s, at(0.52, -0.85, 0, -85));
  add_chair(s, at(1.28, -0.82, 0, -104));
  add_chair(s, at(1.98, -1.45, 0, 172));
  add_chair(s, at(-0.20, -1.38, 0, 14));
  add_window(s, at(0.55, -2.3, 0, 90));
  add_sideboard(s, at(-2.55, 0.75, 0, 0));
  add_picture(s, at(-2.8, 0.83, 1.78, 0), 0.8, 0.5);
  add_door(s, at(-2.8, -1.25, 0, 0));
  add_coat_stand(s, at(-2.45, -2.0, 0, 30));
  add_plant(s, at(-2.3, 1.98, 0, 0));
  add_plant(s, at(2.45, -1.98, 0, 70));
  return s.build();
}

}  // namespace ppm
