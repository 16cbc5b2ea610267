#include "modules/maps/ppm/remesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include "modules/maps/ppm/face_neighbours.hpp"
#include "modules/maps/ppm/face_split.hpp"
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
  bool cut(std::span<const FaceCut> cuts, const Eigen::Vector3f& place, float area_least);
  FaceSide longest_side(const FaceRef& face) const;
  FaceSide terminal_side(FaceRef face);
  Eigen::Vector3f edge_offset(std::span<const FaceSide> sides) const;
  const Geometry& geometry(const FaceRef& face) const { return *edit_.map().table()[face.chunk].geometry; }
  FaceCorners corners(const FaceRef& face) const { return face_corners(geometry(face), face.face); }

  PpmEdit& edit_;
  float cosine_least_;
  FaceNeighbours neighbours_;
  std::set<FaceRef> divided_;
};

bool Divider::cut(std::span<const FaceCut> cuts, const Eigen::Vector3f& place, float area_least) {
  if (!cuts_are_sound(edit_.map(), cuts, place, cosine_least_, area_least)) return false;
  cut_faces(edit_, cuts, place);
  ++counts.inserted;
  for (const auto& c : cuts) {
    divided_.insert(c.face);
    counts.new_faces += c.parts.size();
  }
  return true;
}

void Divider::insert(const Candidate& candidate) {
  constexpr float kAreaLeast = 0.005f;  // slivers arise here; not degenerate faces
  constexpr auto kNew = FacePart::kNew;
  const FaceCut parts{candidate.face, {{{0, 1, kNew}}, {{1, 2, kNew}}, {{2, 0, kNew}}}};
  const FaceCorners corner = corners(candidate.face);
  const auto n = geometry(candidate.face).divisions[candidate.face.face];
  cut({&parts, 1},
      texel_place(corner, n, candidate.bend.i, candidate.bend.j) + candidate.bend.offset * triangle_normal(corner),
      kAreaLeast);
}

/// Divides the edge where the path of ever longer edges from the face ends.
void Divider::bisect(const Candidate& candidate) {
  constexpr float kAreaLeast = 0.25f;  // of half each
  std::vector<FaceSide> sides{terminal_side(candidate.face)};
  if (const auto beyond = neighbours_.across(sides[0])) sides.push_back(*beyond);
  std::vector<FaceCut> cuts;
  for (const auto& [face, k] : sides) {
    if (divided_.contains(face)) return;
    const auto next = (k + 1) % 3, last = (k + 2) % 3;
    cuts.push_back({face, {{{k, FacePart::kNew, last}}, {{FacePart::kNew, next, last}}}});
  }
  const FaceCorners corner = corners(sides[0].face);
  const Eigen::Vector3f middle = 0.5f * (corner[sides[0].k] + corner[(sides[0].k + 1) % 3]),
                        offset = edge_offset(sides);
  for (const float share : {1.0f, 0.5f, 0.25f, 0.0f})
    if (cut(cuts, middle + share * offset, kAreaLeast)) return;
}

/// Edges of one length are told apart by their vertices, so that both faces of an edge choose alike.
FaceSide Divider::longest_side(const FaceRef& face) const {
  const FaceCorners corner = corners(face);
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

/// From the middle of the edge towards the described surface, along the mean of the faces' normals, as far as both
/// faces say: zero where they disagree on the side, as at a step in the surface, and where they fold back on each
/// other.
Eigen::Vector3f Divider::edge_offset(std::span<const FaceSide> sides) const {
  constexpr float kCosineLeast = 0.5f;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  for (const auto& side : sides) normal += triangle_normal(corners(side.face));
  if (normal.norm() < 0.1f) return Eigen::Vector3f::Zero();
  normal.normalize();
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const auto& [face, k] : sides) {
    constexpr float kU[3] = {0.5f, 0.5f, 0.0f}, kV[3] = {0.0f, 0.5f, 0.5f};
    const auto& texels = *edit_.map().table()[face.chunk].texels;
    const float mean = linear_sample(geometry(face), texels, face.face, kU[k], kV[k]).mean;
    const float offset = mean / std::max(triangle_normal(corners(face)).dot(normal), kCosineLeast);
    low = std::min(low, offset);
    high = std::max(high, offset);
  }
  return (low > 0 ? low : high < 0 ? high : 0.0f) * normal;
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
