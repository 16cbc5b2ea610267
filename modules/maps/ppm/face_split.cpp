#include "modules/maps/ppm/face_split.hpp"

#include <cmath>

namespace ppm {
namespace {

FaceCorners corners_of(const FaceCorners& face, const FacePart& part, const Eigen::Vector3f& place) {
  FaceCorners corner;
  for (std::size_t k = 0; k < 3; ++k) corner[k] = part.corner[k] == FacePart::kNew ? place : face[part.corner[k]];
  return corner;
}

Eigen::Vector3f twice_area(const FaceCorners& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]);
}

/// Hands out a count by area, so that the shares add up to it.
class Shares {
 public:
  Shares(std::uint16_t count, float whole) : count_(count), whole_(whole) {}
  std::uint16_t next(float part) {
    done_ += part;
    const auto upto = static_cast<int>(std::lround(std::min(done_ / whole_, 1.0f) * static_cast<float>(count_)));
    return static_cast<std::uint16_t>(upto - std::exchange(given_, upto));
  }

 private:
  int count_, given_ = 0;
  float whole_, done_ = 0;
};

}  // namespace

bool parts_are_sound(const FaceCorners& face, std::span<const FacePart> parts, const Eigen::Vector3f& place,
                     float cosine_least, float area_least) {
  const Eigen::Vector3f whole = twice_area(face);
  for (const auto& part : parts) {
    const Eigen::Vector3f area = twice_area(corners_of(face, part, place));
    if (!(area.norm() >= area_least * whole.norm()) || !(area.dot(whole) >= cosine_least * area.norm() * whole.norm()))
      return false;
  }
  return true;
}

void replace_face(PpmEdit& edit, const FaceRef& face, std::span<const FacePart> parts, std::uint32_t new_id,
                  const Eigen::Vector3f& place) {
  const PpmChunk& chunk = edit.map().table()[face.chunk];
  const Geometry& geometry = *chunk.geometry;
  const FaceCorners old = face_corners(geometry, face.face);
  const auto n = geometry.divisions[face.face];
  const DescribedFace described(old, n, chunk.texels->view(geometry.first_texel[face.face], texel_count(n)));
  const FaceEvidence& evidence = chunk.texels->evidence[face.face];
  float whole = 0;
  for (const auto& part : parts) whole += twice_area(corners_of(old, part, place)).norm();
  Shares hits(evidence.hits, whole), through(evidence.through, whole);

  for (const auto& part : parts) {
    const FaceCorners corner = corners_of(old, part, place);
    std::array<std::uint32_t, 3> ids;
    for (std::size_t k = 0; k < 3; ++k) {
      ids[k] = part.corner[k] == FacePart::kNew ? new_id
                                                : geometry.vertex_id[geometry.face[face.face][part.corner[k]]];
      if (part.corner[k] != FacePart::kNew) edit.use_vertex(ids[k], corner[k]);
    }
    const auto divisions = edit.map().divisions_for(corner[0], corner[1], corner[2]);
    TexelArrays texels;
    described.reexpress(corner, divisions, texels);
    const float area = twice_area(corner).norm();
    edit.add_face(ids, static_cast<std::uint8_t>(divisions), texels.view(0, texels.size()),
                  {hits.next(area), through.next(area), evidence.excess});
  }
  edit.remove_face(face.chunk, face.face);
}

}  // namespace ppm
