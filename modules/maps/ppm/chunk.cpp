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
  return static_cast<std::int64_t>(sizeof *this) + bytes_of(position) + bytes_of(normal) + bytes_of(vertex_id) + bytes_of(face) +
         bytes_of(divisions) + bytes_of(first_texel) + bytes_of(open_edge);
}

std::int64_t Texels::bytes() const {
  return static_cast<std::int64_t>(sizeof *this) + bytes_of(mean) + bytes_of(variance) + bytes_of(evidence);
}

std::uint64_t next_geometry_id() {
  static std::atomic<std::uint64_t> last{0};
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

std::uint32_t nearest_texel(std::uint32_t n, float u, float v) {
  // Round the three barycentric coordinates to the grid; the one that was rounded most follows from the other two.
  const auto steps = static_cast<float>(n);
  const float x = std::clamp(u, 0.0f, 1.0f) * steps;
  const float y = std::clamp(v, 0.0f, 1.0f - x / steps) * steps;
  const float z = std::max(steps - x - y, 0.0f);
  float i = std::round(x), j = std::round(y);
  const float k = std::round(z);
  const float di = std::abs(i - x), dj = std::abs(j - y), dk = std::abs(k - z);
  if (di > dj && di > dk)
    i = steps - j - k;
  else if (dj > dk)
    j = steps - i - k;
  i = std::clamp(i, 0.0f, steps);
  j = std::clamp(j, 0.0f, steps - i);
  return texel_index(n, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
}

}  // namespace ppm
