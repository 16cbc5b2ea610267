#pragma once
#include <cstdint>

#include "framework/slam/frame.hpp"
#include "modules/sources/mesh_rays.hpp"
#include "modules/sources/tof_signal.hpp"

namespace ppm {

/// A simulated range camera in a mesh.
///   exact   what the centre of each pixel sees
///   kinect  structured light: the ray is displaced within the image by lateral_px, the depth has Nguyen's axial noise (that
///           of FrameConditioning's defaults) and, where disparity_step is not 0, the steps of the disparity; views more
///           grazing than 84 degrees give no return
///   tof     time of flight: TofSignal. A pixel that an edge crosses sees nine parts of itself
/// Source: Nguyen, Izadi, Lovell, 3DIMPVT 2012 (kinect, axial and lateral); Khoshelham & Elberink, Sensors 12(2), 2012
/// (focal length, baseline and steps of the disparity); Lange & Seitz, IEEE JQE 37(3), 2001 (tof).
struct MeshCamera {
  enum class Noise { exact, kinect, tof };

  Camera camera;
  Noise noise = Noise::tof;
  double reflectance = 0.5;     ///< of every surface, for tof
  double disparity_step = 0;    ///< px, of the Kinect's own camera (focal length 585 px, baseline 75 mm)
  TofSignal tof;

  /// Fills camera, depth and, for tof, sigma (the true model's) of a frame whose index is set. T_world_camera is the true
  /// pose. The noise is a function of (seed, frame.index, row): the same bytes in whatever order frames are made.
  void render(const MeshRays& mesh, const Pose& T_world_camera, std::uint64_t seed, Frame& frame) const;
};

}  // namespace ppm
