#include "modules/maps/ppm/chunk.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace ppm {
namespace {

template <class T>
std::int64_t bytes_of(const std::vector<T>& v) {
  return static_cast<std::int64_t>(v.capacity() * sizeof(T));
}

}  // namespace

Eigen::Vector3f Geometry::face_normal(std::size_t f) const {
  const auto& [a, b, c] = face[f];
  return (position[b] - position[a]).cross(position[c] - position[a]).normalized();
}

Eigen::Vector3f Geometry::point(std::size_t f, float u, float v) const {
  const auto& [a, b, c] = face[f];
  return (1 - u - v) * position[a] + u * position[b] + v * position[c];
}

std::uint32_t Geometry::find_vertex(std::uint32_t vertex) const {
  auto it = std::lower_bound(vertex_id.begin(), vertex_id.end(), vertex);
  return it != vertex_id.end() && *it == vertex ? static_cast<std::uint32_t>(it - vertex_id.begin()) : kNoVertex;
}

std::int64_t Geometry::bytes() const {
  return static_cast<std::int64_t>(sizeof *this) + bytes_of(position) + bytes_of(normal) + bytes_of(vertex_id) +
         bytes_of(face) + bytes_of(divisions) + bytes_of(first_texel) + bytes_of(open_edge);
}

std::int64_t Texels::bytes() const {
  return static_cast<std::int64_t>(sizeof *this) + bytes_of(mean) + bytes_of(variance) + bytes_of(evidence);
}

std::uint64_t next_geometry_id() {
  static std::atomic<std::uint64_t> last{0};
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace ppm
