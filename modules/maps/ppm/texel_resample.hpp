#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "modules/maps/ppm/described_surface.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// How far a distance may be: the larger of `distance` (m) and so many standard deviations of the old surface there.
struct ResampleTolerance {
  float distance = std::numeric_limits<float>::infinity();
  float sigmas = 0;
};

/// How a new face describes the surface that was there, at the points where the two were compared.
struct ResampleError {
  float distance = 0;  ///< m along the new face's normal, the largest
  float share = 0;     ///< the largest distance in parts of what the tolerance allows there
  float offset = 0;    ///< m, the largest distance of the old surface from the new face itself
  float miss = 0;      ///< m, how far a point lies beside the old surface, the farthest; see SurfaceHit
};

/// Area that a new face has on an old one.
struct FaceOverlap {
  std::uint32_t old_face = 0;
  float area = 0;  ///< m^2
};

struct ResampledFace {
  std::uint8_t divisions = 1;
  TexelArrays texels;
  FaceEvidence evidence;
  ResampleError error;
  std::vector<FaceOverlap> overlap;  ///< ascending
  TexelView view() const { return texels.view(0, texels.size()); }
};

/// What a fit of values at nodes needs of a point: where it lies between them, its weight, its value.
struct NodeObservation {
  const TexelTriangle* node;
  float weight, value;
};

/// Gives new faces the texels with which they describe the surface that old faces describe.
///
/// Lines along a new face's normal are cast onto the surface that the old ones describe (see Meeting) from the face's
/// nodes and from the centres of the triangles between them; each stands for a share of the area (three quarters of a triangle for its centre, the rest
/// for its corners: exact for quadratic functions).
/// - Information, area over variance, is conserved: a node's is the mean of the old surface's 1 / variance, which is
///   interpolated between old texels, over the area that the node stands for. Summed over a face it is what the old
///   surface had there, up to the error of that quadrature. Texels that were never observed keep the prior's variance.
/// - Means are the least-squares fit of the new texture, linear between nodes, to the old surface, weighted by area and
///   information. Where old and new nodes agree so do the means; a coarser texture gets averages, not single old texels.
/// - Colour likewise, weighted by its own information.
/// - Excess is the mean over the area. Hits and votes are divided among all new faces, see share_votes().
class TexelResampler {
 public:
  /// old_faces: not empty, with the map's channels; they must outlive it.
  TexelResampler(std::span<const TexturedFace> old_faces, const PpmSettings& settings,
                 Meeting meeting = Meeting::displaced);

  /// One new face, counter-clockwise, with as many texels as its area deserves. Its evidence has no votes yet.
  ResampledFace resample(const std::array<Eigen::Vector3f, 3>& corner, const ResampleTolerance& tolerance = {});

 private:
  struct Sample {
    TexelTriangle node;  // of the new face
    SurfaceHit hit;
    float area;         // m^2
    float information;  // 1 / m^2
    float sigma2;       // m^2, of the described surface
  };
  void take_samples(const std::array<Eigen::Vector3f, 3>& corner, std::uint32_t divisions);
  void take_sample(float a, float b, std::uint32_t divisions, float area);
  void fit_offsets(TexelArrays& texels);
  void fit_colors(TexelArrays& texels);
  void read_overlap(ResampledFace& face) const;

  std::span<const TexturedFace> old_;
  DescribedSurface surface_;
  const PpmMap sizes_;  // for the divisions of a face; empty
  std::vector<Sample> sample_;
  std::vector<NodeObservation> observation_;
};

/// Divides the votes of old faces among the new ones in proportion to the area that each has on them, to the nearest
/// whole number. An old face that no new one overlaps leaves none.
void share_votes(std::span<const TexturedFace> old_faces, std::span<ResampledFace* const> new_faces);

/// Old faces replaced by new ones: texels and evidence of each new face, complete.
std::vector<ResampledFace> resample_faces(std::span<const TexturedFace> old_faces,
                                          std::span<const std::array<Eigen::Vector3f, 3>> new_corners,
                                          const PpmSettings& settings);

}  // namespace ppm
