#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "framework/slam/camera_parameters.hpp"
#include "framework/slam/surface_patches.hpp"

namespace ppm {

/// A frame's patches in space, and how they move with the camera's parameters.
struct PlacedFrame {
  PlacedFrame(const SurfacePatches& patches, const CameraCorrection& correction, const CameraParameters& parameters);

  const SurfacePatches* patches;   ///< not owned
  Camera camera;                   ///< corrected
  std::vector<PlacedPatch> placed;  ///< as patches->all
  std::vector<PlacedPatch> change;  ///< [patches][parameters] derivative by each parameter
};

/// Which points are compared with which surface, and which of them count.
struct PairGate {
  double distance_m = 0.1;     ///< largest distance between a point and a plane
  double normal_cosine = 0.9;  ///< least, between the normals of the two
  double deviations = 1e9;     ///< largest distance in standard deviations
};

/// Least squares of two frames laid onto each other, each one's points onto the other's planes. Variables: the twist of the
/// first's pose, of the second's (both from the right: T exp(xi)), and the camera's parameters.
/// Source: Rusinkiewicz, Levoy, "Efficient variants of the ICP algorithm", 3DIM 2001 (projective association, point to
/// plane).
struct PairSum {
  Eigen::MatrixXd H;             ///< sum w J J^T [12 + parameters]^2
  Eigen::VectorXd b;             ///< - sum w J r
  double square = 0;             ///< sum of w r^2
  std::size_t points = 0;        ///< within the gate
  std::vector<float> deviation;  ///< |r| sqrt(w) of points, also beyond gate.deviations, every 4th
  std::vector<float> distance_m;  ///< |r| of the same
};

PairSum sum_pair(const PlacedFrame& first, const Pose& T_world_first, const PlacedFrame& second,
                 const Pose& T_world_second, const PairGate& gate);

}  // namespace ppm
