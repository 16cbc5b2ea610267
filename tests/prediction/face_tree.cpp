#include "tests/prediction/face_tree.hpp"

#include <algorithm>

namespace ppm::test {
namespace {

constexpr std::uint32_t kLeaf = 8;  // faces

/// Whether the ray passes the box, grown by a hair for the rounding of the test itself, before `limit`.
bool passes(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin, const Eigen::Array3d& inverse,
            double limit) {
  const Eigen::Array3d a = (box.min() - origin).array() * inverse, b = (box.max() - origin).array() * inverse;
  const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
  return leave >= enter - 1e-9 && leave >= -1e-9 && enter <= limit + 1e-9;
}

}  // namespace

FaceTree::FaceTree(const PpmMap& map, bool cull_back_faces) : cull_(cull_back_faces) {
  for (std::uint32_t c = 0; c < map.table().size(); ++c) {
    const Geometry& g = *map.table()[c].geometry;
    for (std::uint32_t f = 0; f < g.face.size(); ++f) {
      const auto corner = [&](int k) { return g.position[g.face[f][static_cast<std::size_t>(k)]].cast<double>(); };
      const Eigen::Vector3d p0 = corner(0);
      faces_.push_back({c, f, p0, corner(1) - p0, corner(2) - p0});
    }
  }
  if (!faces_.empty()) split(0, static_cast<std::uint32_t>(faces_.size()));
}

void FaceTree::split(std::uint32_t first, std::uint32_t end) {
  const std::size_t at = boxes_.size();
  boxes_.push_back({{}, first, end, 0});
  Eigen::AlignedBox3d middles;
  const auto middle = [](const Face& f) { return Eigen::Vector3d(f.p0 + (f.e1 + f.e2) / 3); };
  for (std::uint32_t i = first; i < end; ++i) {
    const Face& f = faces_[i];
    for (const Eigen::Vector3d& p : {f.p0, Eigen::Vector3d(f.p0 + f.e1), Eigen::Vector3d(f.p0 + f.e2)})
      boxes_[at].bounds.extend(p);
    middles.extend(middle(f));
  }
  boxes_[at].bounds.min().array() -= 1e-9;
  boxes_[at].bounds.max().array() += 1e-9;
  if (end - first <= kLeaf) return;
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const std::uint32_t half = (first + end) / 2;
  std::nth_element(faces_.begin() + first, faces_.begin() + half, faces_.begin() + end,
                   [&](const Face& a, const Face& b) { return middle(a)[axis] < middle(b)[axis]; });
  split(first, half);
  boxes_[at].right = static_cast<std::uint32_t>(boxes_.size());
  split(half, end);
}

template <class Meet>
void FaceTree::visit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, const double& limit,
                     Meet meet) const {
  Eigen::Array3d inverse;
  for (int k = 0; k < 3; ++k) inverse[k] = 1 / (std::abs(direction[k]) > 1e-12 ? direction[k] : 1e-12);
  std::vector<std::uint32_t> open;
  if (!boxes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::uint32_t b = open.back();
    open.pop_back();
    if (!passes(boxes_[b].bounds, origin, inverse, limit)) continue;
    if (boxes_[b].right > 0) {
      open.push_back(boxes_[b].right);
      open.push_back(b + 1);
      continue;
    }
    for (std::uint32_t i = boxes_[b].first; i < boxes_[b].end; ++i) {
      const Face& f = faces_[i];
      const auto hit = plane_crossing(f.p0, f.e1, f.e2, origin, direction);
      if (hit && !(cull_ && hit->cosine > 0) && hit->inside(0))
        meet(OracleHit{hit->range, f.chunk, f.face, hit->u, hit->v});
    }
  }
}

OracleHit FaceTree::nearest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double from) const {
  OracleHit best;
  visit(origin, direction, best.range, [&](const OracleHit& hit) {
    if (hit.range >= from && hit.range < best.range) best = hit;
  });
  return best;
}

std::vector<OracleHit> FaceTree::all(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  std::vector<OracleHit> hits;
  const double no_limit = INFINITY;
  visit(origin, direction, no_limit, [&](const OracleHit& hit) { hits.push_back(hit); });
  return hits;
}

}  // namespace ppm::test
