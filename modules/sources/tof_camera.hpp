#pragma once
#include <cstdint>

#include "framework/slam/frame.hpp"
#include "modules/sources/analytic_scene.hpp"
#include "modules/sources/tof_signal.hpp"

namespace ppm {

/// A simulated time-of-flight camera in an analytic scene. A pixel that an edge crosses sees nine parts of itself.
struct TofCamera : TofSignal {
  Camera camera{176, 144, 220, 220, 87.5, 71.5};  ///< 43.6 x 36.2 degrees
  bool color = false;

  /// Fills camera, depth, sigma (the true model's) and colour of a frame whose index is set. T_world_camera is the true
  /// pose. The noise is a function of (seed, frame.index, row): the same bytes in whatever order frames are made.
  void render(const AnalyticScene& scene, const Pose& T_world_camera, std::uint64_t seed, Frame& frame) const;
};

}  // namespace ppm
