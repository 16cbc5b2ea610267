#pragma once
#include <mrpt/poses/CPose3D.h>

#include "framework/core/se3.hpp"

namespace ppm {

inline Pose from_mrpt(const mrpt::poses::CPose3D& pose) {
  return orthonormalized(pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen());
}
inline mrpt::poses::CPose3D to_mrpt(const Pose& T) {
  return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(T.matrix()));
}

/// Our camera (x right, y down, z forward) in MRPT's sensor (x forward, y left, z up).
inline Pose T_sensor_camera() {
  Pose T = Pose::Identity();
  T.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T;
}

}  // namespace ppm
