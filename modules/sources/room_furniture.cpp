#include "modules/sources/room_furniture.hpp"

#include "modules/sources/room_parts.hpp"

namespace ppm {

using namespace parts;
using Eigen::Isometry3d;

void add_sofa(SceneBuilder& s, const Isometry3d& T) {
  const Color fabric(0.34f, 0.42f, 0.46f);
  s.begin_object("sofa", T);
  box(s, {0.05, 0, 0.22}, {0.85, 2.1, 0.28}, fabric);
  box(s, {-0.33, 0, 0.50}, {0.20, 2.1, 0.56}, fabric, tilt(-6));
  for (double side : {-1.0, 1.0}) box(s, {0.04, side * 0.96, 0.32}, {0.86, 0.20, 0.60}, fabric);
  for (double y : {-0.57, 0.0, 0.57}) box(s, {0.10, y, 0.40}, {0.66, 0.55, 0.12}, fabric * 1.15f);
  box(s, {-0.12, -0.62, 0.63}, {0.14, 0.42, 0.40}, kYellow, tilt(-18) * yaw(12));
  box(s, {-0.10, 0.60, 0.63}, {0.14, 0.42, 0.40}, kRed, tilt(-20) * yaw(-10));
  for (double x : {-0.3, 0.4})
    for (double y : {-0.95, 0.95}) cylinder(s, {x, y, 0.04}, 0.03, 0.08, kWalnut);
}

void add_armchair(SceneBuilder& s, const Isometry3d& T) {
  const Color leather(0.48f, 0.30f, 0.19f);
  s.begin_object("armchair", T);
  box(s, {0.02, 0, 0.23}, {0.74, 0.80, 0.26}, leather);
  box(s, {-0.32, 0, 0.56}, {0.16, 0.80, 0.66}, leather, tilt(-10));
  for (double side : {-1.0, 1.0}) {
    box(s, {0.02, side * 0.36, 0.36}, {0.74, 0.14, 0.50}, leather);
    cylinder(s, {0.02, side * 0.36, 0.61}, 0.08, 0.74, leather, tilt(90));
  }
  box(s, {0.06, 0, 0.40}, {0.60, 0.56, 0.12}, leather * 1.2f);
  box(s, {-0.16, 0.02, 0.64}, {0.12, 0.40, 0.34}, kCream, tilt(-20));
  legs(s, 0.7, 0.76, 0.10, 0.05, kBlack);
}

void add_coffee_table(SceneBuilder& s, const Isometry3d& T) {
  s.begin_object("coffee table", T);
  box(s, {0, 0, 0.415}, {0.60, 1.10, 0.03}, kOak);
  box(s, {0, 0, 0.16}, {0.50, 1.00, 0.02}, kOak);
  legs(s, 0.56, 1.06, 0.40, 0.05, kOak);
  s.begin_object("things on the coffee table", T);
  box(s, {0.05, -0.30, 0.45}, {0.30, 0.22, 0.04}, kBlue, yaw(15));
  box(s, {0.04, -0.30, 0.485}, {0.24, 0.17, 0.03}, kRed, yaw(-8));
  cylinder(s, {-0.05, 0.25, 0.44}, 0.15, 0.02, kWhite);
  sphere(s, {-0.09, 0.23, 0.485}, 0.04, kRed);
  sphere(s, {0.00, 0.22, 0.487}, 0.042, kGreen);
  sphere(s, {-0.04, 0.31, 0.485}, 0.04, kYellow);
  cylinder(s, {0.15, 0.02, 0.475}, 0.04, 0.09, kWhite);
  box(s, {0.0, 0.0, 0.20}, {0.28, 0.40, 0.06}, kCream, yaw(-6));
}

void add_chair(SceneBuilder& s, const Isometry3d& T) {
  s.begin_object("chair", T);
  box(s, {0, 0, 0.45}, {0.42, 0.42, 0.04}, kWalnut);
  legs(s, 0.42, 0.42, 0.43, 0.04, kWalnut);
  for (double y : {-0.19, 0.19}) box(s, {-0.215, y, 0.68}, {0.035, 0.04, 0.46}, kWalnut, tilt(-5));
  for (double z : {0.62, 0.74}) box(s, {-0.215 - (z - 0.68) * 0.087, 0, z}, {0.02, 0.36, 0.05}, kWalnut, tilt(-5));
  box(s, {-0.232, 0, 0.87}, {0.025, 0.40, 0.10}, kWalnut, tilt(-5));
  box(s, {0.01, 0, 0.485}, {0.37, 0.37, 0.03}, kGreen);
}

void add_dining_table(SceneBuilder& s, const Isometry3d& T) {
  s.begin_object("dining table", T);
  box(s, {0, 0, 0.735}, {0.85, 1.50, 0.035}, kOak);
  legs(s, 0.75, 1.40, 0.72, 0.07, kOak);
  for (double x : {-0.34, 0.34}) box(s, {x, 0, 0.67}, {0.025, 1.30, 0.09}, kOak);
  s.begin_object("things on the dining table", T);
  for (double y : {-0.42, 0.38}) {
    cylinder(s, {0.24, y, 0.762}, 0.12, 0.018, kWhite);
    cylinder(s, {0.08, y + 0.16, 0.80}, 0.035, 0.10, kBlue);
  }
  cylinder(s, {-0.05, -0.03, 0.84}, 0.06, 0.18, kTerracotta);
  for (double a : {0.0, 2.1, 4.2})
    sphere(s, {-0.05 + 0.07 * std::cos(a), -0.03 + 0.07 * std::sin(a), 1.0}, 0.075, kGreen);
  sphere(s, {-0.05, -0.03, 1.07}, 0.07, kYellow);
  box(s, {-0.22, 0.42, 0.79}, {0.20, 0.32, 0.08}, kCream, yaw(20));
}

void add_floor_lamp(SceneBuilder& s, const Isometry3d& T) {
  s.begin_object("floor lamp", T);
  cylinder(s, {0, 0, 0.015}, 0.16, 0.03, kBlack);
  cylinder(s, {0, 0, 0.75}, 0.017, 1.46, kSteel);
  cylinder(s, {0, 0, 1.52}, 0.20, 0.30, kCream);
}

void add_plant(SceneBuilder& s, const Isometry3d& T) {
  s.begin_object("plant", T);
  cylinder(s, {0, 0, 0.19}, 0.19, 0.38, kTerracotta);
  cylinder(s, {0, 0, 0.60}, 0.025, 0.50, kWalnut);
  for (int i = 0; i < 7; ++i) {  // a crown of round leaves on a spiral
    const double a = 2.4 * i, r = 0.10 + 0.012 * i;
    sphere(s, {r * std::cos(a), r * std::sin(a), 0.80 + 0.075 * i}, 0.19 - 0.008 * i,
           kGreen * (0.9f + 0.08f * static_cast<float>(i)));
  }
}

void add_coat_stand(SceneBuilder& s, const Isometry3d& T) {
  s.begin_object("coat stand", T);
  cylinder(s, {0, 0, 0.02}, 0.20, 0.04, kWalnut);
  cylinder(s, {0, 0, 0.88}, 0.025, 1.72, kWalnut);
  sphere(s, {0, 0, 1.76}, 0.045, kWalnut);
  for (double a : {20.0, 140.0, 260.0}) {
    const Eigen::Matrix3d R = yaw(a) * tilt(60);
    cylinder(s, Vec(0, 0, 1.62) + R * Vec(0, 0, 0.09), 0.014, 0.18, kWalnut, R);
  }
  box(s, {0.10, 0.06, 1.15}, {0.16, 0.34, 0.85}, kBlue, yaw(25));
  s.paint({{0.08, 0.08, 0.08}, kBlue * 0.6f});  // a checked coat
  cylinder(s, {-0.10, -0.05, 1.30}, 0.09, 0.55, kRed);
}

}  // namespace ppm
