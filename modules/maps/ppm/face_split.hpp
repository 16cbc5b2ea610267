#pragma once
#include <span>
#include <vector>

#include "modules/maps/ppm/boundary.hpp"
#include "modules/maps/ppm/described_face.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"

namespace ppm {

/// A face that is to take over a part of another: its vertices, each a corner of the old face or the new vertex.
struct FacePart {
  static constexpr std::uint32_t kNew = 3;
  std::array<std::uint32_t, 3> corner;  ///< 0, 1, 2: of the old face; kNew
};

/// True when no part, with the new vertex at a place, turns further (cosine) from the face than allowed or has less than
/// this share of its area.
bool parts_are_sound(const FaceCorners& face, std::span<const FacePart> parts, const Eigen::Vector3f& place,
                     float cosine_least, float area_least);

/// Replaces a face by parts around a new vertex of the session: their texels describe the surface that the face
/// described, they share its hits by area, and keep its excess.
void replace_face(PpmEdit& edit, const FaceRef& face, std::span<const FacePart> parts, std::uint32_t new_id,
                  const Eigen::Vector3f& place);

}  // namespace ppm
