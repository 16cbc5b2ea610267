#pragma once
#include <cstddef>
#include <cstdint>

namespace ppm {

/// A depth image as texels read it. Camera frame: x along columns, y along rows, z along the optical axis.
struct GatherImage {
  int cols = 0, rows = 0;
  int row_step = 0, col_step = 1;  ///< entries of the arrays from pixel to pixel
  float fx = 1, fy = 1, cx = 0, cy = 0, inv_fx = 1, inv_fy = 1;
  float lateral_px = 0;          ///< noise across the line of sight, pixels
  const float* depth = nullptr;  ///< m along the optical axis; NaN = no return
  const float* sigma = nullptr;  ///< m, of depth
  /// T_map_camera: the camera's axes in the map frame, one after the other; its centre is centre + centre_rest, m,
  /// which keeps differences from it exact far from the map's origin.
  float axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  float centre[3] = {0, 0, 0}, centre_rest[3] = {0, 0, 0};
};

/// Which measurements update a texel: those within `sigmas` spreads of it, see SurfaceGate.
struct GatherGate {
  float sigmas = 3, pose_variance = 0, map_variance_most = 0, least_cosine = 0;
};

/// The faces of a chunk, and their texels for writing.
struct GatherFaces {
  const float* position = nullptr;             ///< [3*V] m, map frame
  const std::uint32_t* corner = nullptr;       ///< [3*F] indices of vertices, in winding order
  const std::uint8_t* divisions = nullptr;     ///< [F]
  const std::uint32_t* first_texel = nullptr;  ///< [F]
  const float* excess = nullptr;               ///< m^2, of face f at f * excess_step; below 0 counts as 0
  std::size_t excess_step = 1;
  float* mean = nullptr;      ///< m along the face's normal
  float* variance = nullptr;  ///< m^2
};

/// The gather form of the texel update for `count` faces, each once. Each texel takes the distance of the four measured
/// points around its image from the face's plane, weighted bilinearly, of those within the gate (so none from beyond a
/// depth jump); nothing where they have less than half of the weight, or where the nearest pixel has no measurement.
/// Where texels are finer than pixels, one measurement reaches several: its variance grows by the ratio of areas, so
/// that near and far views mix rightly. Faces seen from behind stay as they are. Same bytes on every processor.
void gather_faces(const GatherImage& image, const GatherGate& gate, const GatherFaces& of, const std::uint32_t* faces,
                  std::size_t count);

}  // namespace ppm
