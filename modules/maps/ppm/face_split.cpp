#include "modules/maps/ppm/face_split.hpp"

#include "modules/maps/ppm/texel_resample.hpp"

namespace ppm {
namespace {

FaceCorners part_corners(const FaceCorners& face, const FacePart& part, const Eigen::Vector3f& place) {
  FaceCorners corner;
  for (std::size_t k = 0; k < 3; ++k) corner[k] = part.corner[k] == FacePart::kNew ? place : face[part.corner[k]];
  return corner;
}

Eigen::Vector3f twice_area(const FaceCorners& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]);
}

/// The vertices of a part, known to the session.
std::array<std::uint32_t, 3> part_ids(PpmEdit& edit, const FaceCut& cut, const FacePart& part, std::uint32_t new_id) {
  const Geometry& geometry = *edit.map().table()[cut.face.chunk].geometry;
  std::array<std::uint32_t, 3> ids;
  for (std::size_t k = 0; k < 3; ++k) {
    ids[k] = new_id;
    if (part.corner[k] == FacePart::kNew) continue;
    const auto v = geometry.face[cut.face.face][part.corner[k]];
    ids[k] = geometry.vertex_id[v];
    edit.use_vertex(ids[k], geometry.position[v]);
  }
  return ids;
}

}  // namespace

bool cuts_are_sound(const PpmMap& map, std::span<const FaceCut> cuts, const Eigen::Vector3f& place, float cosine_least,
                    float area_least) {
  for (const auto& cut : cuts) {
    const FaceCorners face = face_corners(*map.table()[cut.face.chunk].geometry, cut.face.face);
    const Eigen::Vector3f whole = twice_area(face);
    for (const auto& part : cut.parts) {
      const Eigen::Vector3f area = twice_area(part_corners(face, part, place));
      if (!(area.norm() >= area_least * whole.norm()) ||
          !(area.dot(whole) >= cosine_least * area.norm() * whole.norm()))
        return false;
    }
  }
  return true;
}

void cut_faces(PpmEdit& edit, std::span<const FaceCut> cuts, const Eigen::Vector3f& place) {
  std::vector<TexturedFace> old_faces;
  std::vector<FaceCorners> corners;
  for (const auto& cut : cuts) {
    old_faces.push_back(textured_face(edit.map().table()[cut.face.chunk], cut.face.face));
    for (const auto& part : cut.parts) corners.push_back(part_corners(old_faces.back().corner, part, place));
  }
  const auto faces = resample_faces(old_faces, corners, edit.map().settings());
  const auto new_id = edit.add_vertex(place);
  auto face = faces.begin();
  for (const auto& cut : cuts) {
    for (const auto& part : cut.parts) {
      edit.add_face(part_ids(edit, cut, part, new_id), face->divisions, face->view(), face->evidence);
      ++face;
    }
    edit.remove_face(cut.face.chunk, cut.face.face);
  }
}

}  // namespace ppm
