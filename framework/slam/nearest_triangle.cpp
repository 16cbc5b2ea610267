#include "framework/slam/nearest_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ppm {

namespace {

constexpr std::uint32_t kLeaf = 4;

float squared_distance_to_edge(const Eigen::Vector3f& p, const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const Eigen::Vector3f ab = b - a;
  const float length2 = ab.squaredNorm();
  const float t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0f, 1.0f) : 0.0f;
  return (p - a - t * ab).squaredNorm();
}

}  // namespace

float squared_distance(const Eigen::Vector3f& p, const std::array<Eigen::Vector3f, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3f normal = (b - a).cross(c - a);
  // Inside of all three edges, seen along the normal: the plane is nearest.
  const bool over_face = normal.dot((b - a).cross(p - a)) > 0 && normal.dot((c - b).cross(p - b)) > 0 &&
                         normal.dot((a - c).cross(p - c)) > 0;
  if (over_face) {
    const float off = normal.dot(p - a);
    return off * off / normal.squaredNorm();
  }
  return std::min({squared_distance_to_edge(p, a, b), squared_distance_to_edge(p, b, c), squared_distance_to_edge(p, c, a)});
}

NearestTriangle::NearestTriangle(const std::vector<Eigen::Vector3f>& position, const std::vector<Face>& face) {
  triangles_.reserve(face.size());
  for (const auto& [a, b, c] : face) triangles_.push_back({position[a], position[b], position[c]});
  nodes_.reserve(face.size());
  if (!face.empty()) build(0, static_cast<std::uint32_t>(face.size()));
}

void NearestTriangle::build(std::uint32_t first, std::uint32_t count) {
  const auto self = nodes_.size();
  auto& node = nodes_.emplace_back();
  Eigen::AlignedBox3f centers;
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const auto& corner : triangles_[i]) node.box.extend(corner);
    centers.extend(triangles_[i][0] + triangles_[i][1] + triangles_[i][2]);
  }
  node.at = first;
  node.count = count;
  if (count <= kLeaf) return;
  Eigen::Index axis = 0;
  centers.sizes().maxCoeff(&axis);
  const auto begin = triangles_.begin() + first;
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [axis](const Triangle& s, const Triangle& t) {
    return s[0][axis] + s[1][axis] + s[2][axis] < t[0][axis] + t[1][axis] + t[2][axis];
  });
  build(first, half);
  nodes_[self].count = 0;
  nodes_[self].at = static_cast<std::uint32_t>(nodes_.size());
  build(first + half, count - half);
}

double NearestTriangle::distance(const Eigen::Vector3f& p) const {
  struct Branch {
    std::uint32_t node;
    float squared;  // distance to its box
  };
  constexpr std::size_t kDeep = 64;  // halved 32 times at most, one sibling a level
  std::array<Branch, kDeep> stack;
  std::size_t waiting = 0;
  float best = std::numeric_limits<float>::infinity();
  if (!nodes_.empty()) stack[waiting++] = {0, 0.0f};
  while (waiting > 0) {
    const auto [at, squared] = stack[--waiting];
    if (squared >= best) continue;
    const Node& node = nodes_[at];
    for (std::uint32_t i = node.at; i < node.at + node.count; ++i) best = std::min(best, squared_distance(p, triangles_[i]));
    if (node.count > 0) continue;
    Branch near{at + 1, nodes_[at + 1].box.squaredExteriorDistance(p)};
    Branch far{node.at, nodes_[node.at].box.squaredExteriorDistance(p)};
    if (far.squared < near.squared) std::swap(near, far);
    stack[waiting++] = far;
    stack[waiting++] = near;
  }
  return std::sqrt(static_cast<double>(best));
}

}  // namespace ppm
