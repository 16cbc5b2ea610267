#include "modules/maps/ppm/remesh.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "modules/maps/ppm/face_neighbours.hpp"
#include "modules/maps/ppm/face_split.hpp"
#include "modules/maps/ppm/offset_fusion.hpp"
#include "modules/maps/ppm/texel_sample.hpp"

namespace ppm {
namespace {

struct Candidate {
  FaceRef face;
  TexelBend bend;
};

float longest_edge(const FaceCorners& c) {
  return std::sqrt(std::max({(c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm()}));
}

/// The faces that should bend, the worst first.
std::vector<Candidate> find_candidates(const PpmMap& map, const RemeshSettings& settings) {
  std::vector<Candidate> found;
  for (std::uint32_t c = 0; c < map.table().size(); ++c) {
    const Geometry& geometry = *map.table()[c].geometry;
    for (std::uint32_t f = 0; f < geometry.face.size(); ++f) {
      const auto n = geometry.divisions[f];
      if (n < 2) continue;
      const auto texels = map.table()[c].texels->view(geometry.first_texel[f], texel_count(n));
      const auto bend = largest_bend(n, texels, settings.bend);
      if (bend && longest_edge(face_corners(geometry, f)) >= settings.edge_least) found.push_back({{c, f}, *bend});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return std::abs(a.bend.error) > std::abs(b.bend.error);
  });
  return found;
}

/// Divides faces of one session, each at most once.
class Divider {
 public:
  Divider(PpmEdit& edit, const RemeshSettings& settings)
      : edit_(edit), cosine_least_(std::cos(settings.turn_most)), neighbours_(edit.map()) {}

  void insert(const Candidate& candidate);
  void bisect(const Candidate& candidate);
  RemeshCounts counts;

 private:
  /// One of the one or two faces that share the edge to be divided.
  struct Half {
    FaceSide side;
    FaceCorners corner;
    std::array<FacePart, 2> parts;
  };
  Half half(const FaceSide& side) const;
  FaceSide longest_side(const FaceRef& face) const;
  FaceSide terminal_side(FaceRef face);
  Eigen::Vector3f edge_offset(const std::vector<Half>& halves) const;
  const Geometry& geometry(const FaceRef& face) const { return *edit_.map().table()[face.chunk].geometry; }

  PpmEdit& edit_;
  float cosine_least_;
  FaceNeighbours neighbours_;
  std::set<FaceRef> divided_;
};

void Divider::insert(const Candidate& candidate) {
  constexpr float kAreaLeast = 0.005f;  // slivers arise here; not degenerate faces
  static constexpr std::array<FacePart, 3> kParts{
      {{{0, 1, FacePart::kNew}}, {{1, 2, FacePart::kNew}}, {{2, 0, FacePart::kNew}}}};
  const auto& g = geometry(candidate.face);
  const FaceCorners corner = face_corners(g, candidate.face.face);
  const Eigen::Vector3f place =
      texel_place(corner, g.divisions[candidate.face.face], candidate.bend.i, candidate.bend.j) +
      candidate.bend.error * triangle_normal(corner);
  if (!parts_are_sound(corner, kParts, place, cosine_least_, kAreaLeast)) return;
  replace_face(edit_, candidate.face, kParts, edit_.add_vertex(place), place);
  ++counts.inserted;
  counts.new_faces += kParts.size();
}

/// Divides the edge where the path of ever longer edges from the face ends.
void Divider::bisect(const Candidate& candidate) {
  constexpr float kAreaLeast = 0.25f;  // of half each
  const FaceSide side = terminal_side(candidate.face);
  std::vector<Half> halves{half(side)};
  if (const auto beyond = neighbours_.across(side)) halves.push_back(half(*beyond));
  for (const auto& h : halves)
    if (divided_.contains(h.side.face)) return;
  const auto& [corner, k] = std::pair(halves[0].corner, side.k);
  const Eigen::Vector3f middle = 0.5f * (corner[k] + corner[(k + 1) % 3]), offset = edge_offset(halves);
  for (const float share : {1.0f, 0.5f, 0.25f, 0.0f}) {
    const Eigen::Vector3f place = middle + share * offset;
    if (!std::all_of(halves.begin(), halves.end(),
                     [&](const Half& h) { return parts_are_sound(h.corner, h.parts, place, cosine_least_, kAreaLeast); }))
      continue;
    const auto id = edit_.add_vertex(place);
    for (const auto& h : halves) {
      replace_face(edit_, h.side.face, h.parts, id, place);
      divided_.insert(h.side.face);
      counts.new_faces += h.parts.size();
    }
    ++counts.inserted;
    return;
  }
}

Divider::Half Divider::half(const FaceSide& side) const {
  const auto a = side.k, b = (side.k + 1) % 3, c = (side.k + 2) % 3;
  return {side,
          face_corners(geometry(side.face), side.face.face),
          {{{{a, FacePart::kNew, c}}, {{FacePart::kNew, b, c}}}}};
}

/// Edges of one length are told apart by their vertices, so that both faces of an edge choose alike.
FaceSide Divider::longest_side(const FaceRef& face) const {
  const FaceCorners corner = face_corners(geometry(face), face.face);
  FaceSide longest{face, 0};
  std::pair<float, Edge> most{-1.0f, {}};
  for (std::uint32_t k = 0; k < 3; ++k) {
    Edge edge = neighbours_.edge({face, k});
    if (edge[0] > edge[1]) std::swap(edge[0], edge[1]);
    const std::pair length((corner[(k + 1) % 3] - corner[k]).squaredNorm(), edge);
    if (length > most) {
      most = length;
      longest.k = k;
    }
  }
  return longest;
}

FaceSide Divider::terminal_side(FaceRef face) {
  for (;;) {
    const FaceSide side = longest_side(face);
    const auto beyond = neighbours_.across(side);
    if (!beyond || longest_side(beyond->face).k == beyond->k) return side;
    face = beyond->face;
  }
}

/// From the middle of the edge to the described surface, along the mean of the faces' normals; zero where they fold
/// back on each other.
Eigen::Vector3f Divider::edge_offset(const std::vector<Half>& halves) const {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  for (const auto& h : halves) normal += triangle_normal(h.corner);
  if (normal.norm() < 0.1f) return Eigen::Vector3f::Zero();
  normal.normalize();
  OffsetFusion fusion;
  for (const auto& [side, corner, parts] : halves) {
    constexpr float kU[3] = {0.5f, 0.5f, 0.0f}, kV[3] = {0.0f, 0.5f, 0.5f};
    const auto texel = linear_sample(geometry(side.face), *edit_.map().table()[side.face.chunk].texels, side.face.face,
                                     kU[side.k], kV[side.k]);
    fusion.add(texel.mean, texel.variance, triangle_normal(corner).dot(normal));
  }
  return fusion.offset() * normal;
}

}  // namespace

std::shared_ptr<const PpmMap> remesh(std::shared_ptr<const PpmMap> map, const RemeshSettings& settings,
                                     RemeshCounts* counts) {
  const auto candidates = find_candidates(*map, settings);
  if (counts) *counts = {candidates.size(), 0, 0};
  if (candidates.empty()) return map;
  PpmEdit edit(std::move(map));
  Divider divider(edit, settings);
  for (const auto& candidate : candidates)
    settings.form == SplitForm::bisect ? divider.bisect(candidate) : divider.insert(candidate);
  if (counts) *counts = {candidates.size(), divider.counts.inserted, divider.counts.new_faces};
  return edit.commit();
}

}  // namespace ppm
