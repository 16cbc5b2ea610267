#include "modules/sources/room_furniture.hpp"
#include "modules/sources/room_parts.hpp"

namespace ppm {

using namespace parts;
using Eigen::Isometry3d;

void add_bookshelf(SceneBuilder& s, const Isometry3d& T) {
  constexpr double kDepth = 0.32, kWidth = 1.70, kHeight = 2.0;
  constexpr int kShelves = 5;
  s.begin_object("bookshelf", T);
  for (double y : {-1.0, 0.0, 1.0}) box(s, {0, y * (kWidth / 2 - 0.0125), kHeight / 2}, {kDepth, 0.025, kHeight}, kOak);
  box(s, {-kDepth / 2 + 0.005, 0, kHeight / 2}, {0.01, kWidth, kHeight}, kOak);
  for (int k = 0; k <= kShelves; ++k) box(s, {0, 0, 0.06 + 0.385 * k}, {kDepth, kWidth, 0.025}, kOak);

  const Color covers[] = {kRed, kBlue, kCream, kGreen, kYellow, kTerracotta, kWhite, Color(0.45f, 0.32f, 0.50f)};
  for (int shelf = 0; shelf < kShelves; ++shelf) {
    s.begin_object("books", T);
    const double floor = 0.0725 + 0.385 * shelf;
    for (int half = 0; half < 2; ++half) {
      double y = half == 0 ? -0.81 : 0.04;
      const int count = 6 + (shelf + 2 * half) % 4;
      for (int i = 0; i < count; ++i) {  // sizes that look random and are not; fronts nearly in line, as books stand
        const int h = (shelf * 37 + half * 17 + i * 11) % 13;
        const double thick = 0.040 + 0.003 * h, high = 0.22 + 0.007 * ((h * 5) % 13),
                     deep = 0.27 + 0.002 * ((h * 7) % 13);
        box(s, {-kDepth / 2 + 0.01 + deep / 2, y + thick / 2, floor + high / 2}, {deep, thick, high},
            covers[(h + i) % 8]);
        y += thick;
      }
      if ((shelf + half) % 3 == 0) cylinder(s, {0.04, y + 0.12, floor + 0.11}, 0.08, 0.22, kBlue);
      if ((shelf + half) % 3 == 1) sphere(s, {0.04, y + 0.13, floor + 0.10}, 0.10, kTerracotta);
      if ((shelf + half) % 3 == 2) box(s, {0.03, y + 0.14, floor + 0.08}, {0.22, 0.20, 0.16}, kCream, yaw(12));
    }
  }
}

void add_sideboard(SceneBuilder& s, const Isometry3d& T) {
  s.begin_object("sideboard", T);
  box(s, {0, 0, 0.42}, {0.44, 1.80, 0.56}, kOak);
  box(s, {0, 0, 0.715}, {0.48, 1.86, 0.03}, kOak);
  legs(s, 0.38, 1.70, 0.14, 0.05, kOak);
  for (double y : {-0.59, 0.0, 0.59})
    for (double z : {0.29, 0.55}) {
      box(s, {0.225, y, z}, {0.02, 0.56, 0.235}, kOak * 1.15f);
      sphere(s, {0.25, y, z + 0.02}, 0.018, kSteel);
    }
  s.begin_object("television", T);
  box(s, {-0.06, 0.08, 1.11}, {0.05, 1.05, 0.62}, kBlack * 1.3f, yaw(6));
  box(s, {-0.06, 0.08, 0.77}, {0.06, 0.10, 0.12}, kBlack * 1.5f, yaw(6));
  box(s, {-0.04, 0.08, 0.74}, {0.24, 0.45, 0.02}, kBlack * 1.5f, yaw(6));
  s.begin_object("things on the sideboard", T);
  cylinder(s, {0.05, -0.74, 0.80}, 0.08, 0.14, kWhite);
  for (double a : {0.5, 2.2, 4.0, 5.3})
    sphere(s, {0.05 + 0.07 * std::cos(a), -0.74 + 0.07 * std::sin(a), 0.95}, 0.08, kGreen);
  sphere(s, {0.05, -0.74, 1.03}, 0.08, kGreen * 1.2f);
  box(s, {0.04, 0.76, 0.84}, {0.17, 0.14, 0.22}, kWalnut, yaw(-15));
}

void add_door(SceneBuilder& s, const Isometry3d& T) {
  s.begin_object("door", T);
  for (double side : {-1.0, 1.0}) box(s, {0.03, side * 0.48, 1.04}, {0.06, 0.08, 2.08}, kWhite);
  box(s, {0.03, 0, 2.06}, {0.06, 1.04, 0.08}, kWhite);
  box(s, {0.01, 0, 1.01}, {0.02, 0.88, 2.02}, kOak);
  for (double y : {-0.21, 0.21})
    for (double z : {0.50, 1.45}) box(s, {0.025, y, z}, {0.03, 0.30, 0.74}, kOak * 0.9f);
  cylinder(s, {0.045, 0.37, 1.03}, 0.025, 0.05, kSteel, tilt(90));
  box(s, {0.075, 0.32, 1.03}, {0.02, 0.13, 0.022}, kSteel);
}

void add_window(SceneBuilder& s, const Isometry3d& T) {
  const Color glass(0.30f, 0.40f, 0.48f), linen(0.78f, 0.70f, 0.60f);
  s.begin_object("window", T);
  box(s, {0.005, 0, 1.50}, {0.01, 1.60, 1.20}, glass);
  for (double y : {-0.80, 0.0, 0.80}) box(s, {0.03, y, 1.50}, {0.06, 0.07, 1.28}, kWhite);
  for (double z : {0.89, 1.72, 2.11}) box(s, {0.03, 0, z}, {0.06, 1.67, 0.07}, kWhite);
  box(s, {0.09, 0, 0.85}, {0.20, 1.80, 0.03}, kWhite);
  s.begin_object("radiator", T);
  box(s, {0.075, 0, 0.44}, {0.07, 1.40, 0.56}, kWhite);
  for (int i = 0; i < 7; ++i) box(s, {0.115, -0.60 + 0.2 * i, 0.44}, {0.02, 0.10, 0.50}, kWhite);
  s.begin_object("curtains", T);
  for (double side : {-1.0, 1.0})
    for (int i = 0; i < 6; ++i)
      cylinder(s, {0.10 + 0.02 * (i % 2), side * (0.84 + 0.085 * i), 1.20}, 0.055, 2.14, linen);
  cylinder(s, {0.11, 0, 2.31}, 0.018, 2.70, kSteel, yaw(90) * tilt(90));
}

void add_picture(SceneBuilder& s, const Isometry3d& T, double width, double height) {
  constexpr double kFrame = 0.05;
  s.begin_object("picture", T);
  for (double side : {-0.5, 0.5}) {
    box(s, {0.02, side * (width - kFrame), 0}, {0.04, kFrame, height}, kWalnut);
    box(s, {0.02, 0, side * (height - kFrame)}, {0.04, width, kFrame}, kWalnut);
  }
  box(s, {0.005, 0, 0}, {0.01, width - kFrame, height - kFrame}, Color(0.60f, 0.72f, 0.82f));
  box(s, {0.008, 0, -height * 0.28}, {0.014, width - kFrame, height * 0.36}, kGreen * 1.3f);
  cylinder(s, {0.008, width * 0.2, height * 0.18}, height * 0.12, 0.014, kYellow, tilt(90));
}

}  // namespace ppm
