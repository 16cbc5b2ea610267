#pragma once
#include <span>
#include <vector>

#include "modules/maps/ppm/boundary.hpp"
#include "modules/maps/ppm/described_face.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"

namespace ppm {

/// What takes over a part of a face: its corners are corners of the face or the new vertex.
struct FacePart {
  static constexpr std::uint32_t kNew = 3;
  std::array<std::uint32_t, 3> corner;  ///< 0, 1, 2: of the face; kNew
};

/// A face that is to be divided around a new vertex.
struct FaceCut {
  FaceRef face;
  std::vector<FacePart> parts;
};

/// True when no part, with the new vertex at a place, turns further from its face than allowed (cosine) or has less
/// than this share of its area.
bool cuts_are_sound(const PpmMap& map, std::span<const FaceCut> cuts, const Eigen::Vector3f& place, float cosine_least,
                    float area_least);

/// Replaces faces by their parts around one new vertex: texels that describe the surface that the faces described,
/// evidence by area (see TexelResampler).
void cut_faces(PpmEdit& edit, std::span<const FaceCut> cuts, const Eigen::Vector3f& place);

}  // namespace ppm
