#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "modules/maps/ppm/pixel_classes.hpp"

namespace ppm {

struct TriangleSettings {
  SurfaceGate gate;
  float gate_sigmas =
      4;  ///< a sample fits when the measurement lies within so many gate spreads of the triangle's plane
  float fit_share = 0.75f;     ///< least share of samples that fit
  float own_share = 0.40f;     ///< most share of samples that the map explains already by their own hit
  float cosine_least = 0.3f;   ///< least cosine between the triangle's normal and the line of sight to its centroid
  float steep_cosine = 0.25f;  ///< a triangle seen at less than this must also agree with the normals at its corners: a
                               ///< slanted surface does, a bridge over a depth jump does not
  float steep_agree = 0.5f;    ///< least mean cosine between the triangle's normal and those at its corners, then
};

/// Whether a triangle that is proposed as new surface agrees with the image: samples are the pixels inside it, its
/// centroid and the middles of its edges. It stands in place of a threshold for depth jumps: a triangle across a jump
/// fits no measurement, and one through flying pixels stands on edge, unlike the surfaces on either side. corner:
/// relative to the view's centre, wound so that the normal faces the camera; normal: of the surface at them; pixel:
/// their images.
bool is_surface(const UpdateView& view, const std::vector<std::uint8_t>& classes, const TriangleSettings& settings,
                const std::array<Eigen::Vector3f, 3>& corner, const std::array<Eigen::Vector3f, 3>& normal,
                const std::array<Eigen::Vector2f, 3>& pixel);

}  // namespace ppm
