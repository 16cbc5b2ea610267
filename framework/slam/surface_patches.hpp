#pragma once
#include <vector>

#include "framework/slam/camera_correction.hpp"
#include "framework/slam/frame.hpp"

namespace ppm {

/// A spot of a frame where the surface is flat: the plane that fits 1/depth, which is linear in the pixel on a plane.
/// It is kept as measured, so that it can be placed in space by any correction of the camera.
struct SurfacePatch {
  double x = 0, y = 0;              ///< px, centre
  double disparity = 0;             ///< 1/m there
  double slope_x = 0, slope_y = 0;  ///< of the disparity, 1/m a pixel
  double sigma = 0;                 ///< m, standard deviation of one depth there, and 2 mm for what is not flat about a surface
};

/// The flat spots of one frame on a regular grid.
struct SurfacePatches {
  Camera camera;  ///< of the frame
  int step = 1;   ///< px between neighbours of the grid, which starts at (step/2, step/2)
  int cols = 0, rows = 0;         ///< of the grid
  std::vector<SurfacePatch> all;  ///< row-major
  std::vector<int> at;            ///< [rows*cols] index into `all`; -1 where the surface is not flat

  /// The patch around a pixel, an index into `all`; -1 where there is none or beyond the image.
  int around(double x, double y) const;
};

/// Fits planes to squares of 2 * step + 1 pixels. A spot is taken where at least 80 % of its pixels have a return, the plane
/// fits them to 1.5 sigma (rms), and is seen at less than 65 degrees.
SurfacePatches surface_patches(const Frame& frame, int step);

/// A patch in space, in the frame of a camera: `point` its centre, m; the plane is plane . p = 1.
struct PlacedPatch {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();  ///< 1/m, away from the camera
  double sigma = 0;                                 ///< m, of the depth
};
/// camera: as read; the correction is applied to it and to the patch.
PlacedPatch placed(const SurfacePatch& patch, const Camera& camera, const CameraCorrection& correction);

}  // namespace ppm
