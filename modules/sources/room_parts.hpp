#pragma once
#include "modules/sources/scene_builder.hpp"

namespace ppm::parts {

/// Short names for building objects from solids; positions and full sizes in m, in the object's frame.
using Color = Eigen::Vector3f;
using Vec = Eigen::Vector3d;

inline const Color kOak{0.62f, 0.45f, 0.28f}, kWalnut{0.36f, 0.24f, 0.16f}, kWhite{0.85f, 0.84f, 0.80f},
    kBlack{0.09f, 0.09f, 0.10f}, kSteel{0.55f, 0.56f, 0.58f}, kGreen{0.22f, 0.42f, 0.20f},
    kTerracotta{0.68f, 0.36f, 0.24f}, kBlue{0.25f, 0.38f, 0.58f}, kCream{0.80f, 0.74f, 0.62f},
    kRed{0.65f, 0.20f, 0.18f}, kYellow{0.82f, 0.66f, 0.22f};

inline Eigen::Matrix3d yaw(double degrees) {
  return Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Vec::UnitZ()).toRotationMatrix();
}
inline Eigen::Matrix3d tilt(double degrees) {  // the top leans towards +x
  return Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Vec::UnitY()).toRotationMatrix();
}
inline Eigen::Isometry3d at(double x, double y, double z, double yaw_degrees) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = yaw(yaw_degrees);
  T.translation() = Vec(x, y, z);
  return T;
}

inline void box(SceneBuilder& s, const Vec& center, const Vec& size, const Color& color,
                const Eigen::Matrix3d& R = Eigen::Matrix3d::Identity()) {
  s.add(Solid::Shape::box, center, size / 2, color, R);
}
/// An upright cylinder unless turned.
inline void cylinder(SceneBuilder& s, const Vec& center, double radius, double height, const Color& color,
                     const Eigen::Matrix3d& R = Eigen::Matrix3d::Identity()) {
  s.add(Solid::Shape::cylinder, center, {radius, radius, height / 2}, color, R);
}
inline void sphere(SceneBuilder& s, const Vec& center, double radius, const Color& color) {
  s.add(Solid::Shape::sphere, center, Vec::Constant(radius), color);
}
/// Four legs under a rectangle of length x width, from the floor to `height`.
inline void legs(SceneBuilder& s, double length, double width, double height, double thickness, const Color& color) {
  for (double x : {-0.5, 0.5})
    for (double y : {-0.5, 0.5})
      box(s, {x * (length - thickness), y * (width - thickness), height / 2}, {thickness, thickness, height}, color);
}

}  // namespace ppm::parts
