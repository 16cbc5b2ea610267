#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "modules/maps/ppm/face_votes.hpp"
#include "modules/maps/ppm/pixel_classes.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"
#include "modules/maps/ppm/texel_gather.hpp"

namespace ppm {

/// Which way measurements reach texels.
enum class TexelForm {
  scatter,  ///< each pixel that hit updates the texel nearest to its hit: the paper's form
  gather,   ///< each texel of a visible face is projected and reads the measurement there
};

/// What the texels of a new face start with.
enum class NewTexels {
  measured,  ///< the map's prior, fused with what this image measures at each (gather)
  sensor,    ///< zero mean and the sensor's variance: the paper's form
};

struct TexelSettings {
  TexelForm form = TexelForm::gather;
  NewTexels new_texels = NewTexels::measured;
  float least_pixels = 1.5f;  ///< texels of new faces are no finer than so many pixels' footprints where they are seen
  SurfaceGate gate;
  float gate_sigmas = 3;  ///< measurements farther from the texel's surface than so many gate spreads are left out
};

/// Variance of a measured point along a surface's normal: that of its depth and that of its place in the image, each as
/// far as the normal shows it. sigma: m, of the depth; cosine: |normal . line of sight|; lateral: m, across the line of
/// sight.
float variance_along_normal(float sigma, float cosine, float lateral);

/// Conjugate Gaussian: fuses a measurement (offset, variance) into a texel (mean, variance). Source: paper,
/// section 4.3.
inline void fuse(float& mean, float& variance, float offset, float measured_variance) {
  const float sum = variance + measured_variance;
  mean += variance / sum * (offset - mean);
  variance = variance * measured_variance / sum;
}

/// A camera at a pose as texels read its image, without the image.
GatherImage gather_image(const Camera& camera, const Pose& T_map_camera);
/// The measured image of a view; refers to it.
GatherImage gather_image(const UpdateView& view);
GatherGate gather_gate(const TexelSettings& settings);
/// All faces of a chunk; refers to both.
GatherFaces gather_faces_of(const Geometry& geometry, Texels& texels);

/// The gather form for one face, of the map or new: see gather_faces(). corner: relative to the view's centre, in
/// winding order; excess: m^2, the face's added_variance(): it widens the gate, and is no noise of a texel, which would
/// then forget how much better near views are; mean, variance [texel_count(divisions)] are updated.
void gather_face(const UpdateView& view, const TexelSettings& settings, const std::array<Eigen::Vector3f, 3>& corner,
                 std::uint32_t divisions, float excess, std::span<float> mean, std::span<float> variance);

/// First texels of a new face, [texel_count(divisions)] each, all assigned. prior_variance: the map's, m^2; it stands
/// in for the sensor's where the face's centroid has no measurement. excess: as in gather_face().
void start_texels(const UpdateView& view, const TexelSettings& settings, const std::array<Eigen::Vector3f, 3>& corner,
                  std::uint32_t divisions, float prior_variance, float excess, std::span<float> mean,
                  std::span<float> variance);

/// The corners of a face, relative to the view's centre.
std::array<Eigen::Vector3f, 3> corners_in(const UpdateView& view, const Geometry& geometry, std::uint32_t face);

/// Calls body(geometry, face, texels) once for each face of the map, several faces to a worker's turn; texels: of the
/// face's chunk, for writing. faces: each once.
void for_each_face(const std::vector<FaceRef>& faces, const Workers& workers, PpmEdit& edit,
                   const std::function<void(const Geometry&, std::uint32_t face, Texels&)>& body);

/// Updates the texels of the faces in view. `faces`: those that rays met (see FaceTallies), without the removed ones.
/// The scatter form uses the pixels of class kOwnHit.
void update_texels(const UpdateView& view, const std::vector<std::uint8_t>& classes, const std::vector<FaceRef>& faces,
                   const TexelSettings& settings, const Workers& workers, PpmEdit& edit);

}  // namespace ppm
