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

template <class... T>
void shrink_each(std::vector<T>&... arrays) {
  (arrays.shrink_to_fit(), ...);
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

void Geometry::shrink_to_fit() {
  shrink_each(position, normal, vertex_id, face, divisions, first_texel, open_edge);
}

void Texels::shrink_to_fit() {
  shrink_each(mean, variance, color, color_variance, evidence, settled);
}

std::int64_t Geometry::bytes() const {
  return static_cast<std::int64_t>(sizeof *this) + bytes_of(position) + bytes_of(normal) + bytes_of(vertex_id) +
         bytes_of(face) + bytes_of(divisions) + bytes_of(first_texel) + bytes_of(open_edge);
}

std::int64_t Texels::bytes() const {
  return static_cast<std::int64_t>(sizeof *this) + bytes_of(mean) + bytes_of(variance) + bytes_of(color) +
         bytes_of(color_variance) + bytes_of(evidence) + bytes_of(settled);
}

TexelView TexelArrays::view(std::size_t first, std::size_t count) const {
  TexelView part{std::span(mean).subspan(first, count), std::span(variance).subspan(first, count)};
  if (const auto c = channels(); c > 0) {
    part.color = std::span(color).subspan(c * first, c * count);
    part.color_variance = std::span(color_variance).subspan(first, count);
  }
  return part;
}

void TexelArrays::append(const TexelView& texels) {
  auto add = [](std::vector<float>& to, std::span<const float> from) { to.insert(to.end(), from.begin(), from.end()); };
  add(mean, texels.mean);
  add(variance, texels.variance);
  add(color, texels.color);
  add(color_variance, texels.color_variance);
}

void TexelArrays::move_down(std::size_t from, std::size_t to, std::size_t count) {
  auto move = [&](std::vector<float>& values, std::size_t per_texel) {
    std::copy_n(values.data() + per_texel * from, per_texel * count, values.data() + per_texel * to);
  };
  move(mean, 1);
  move(variance, 1);
  if (const auto c = channels(); c > 0) {
    move(color, c);
    move(color_variance, 1);
  }
}

void TexelArrays::truncate(std::size_t count) {
  if (const auto c = channels(); c > 0) {
    color.resize(c * count);
    color_variance.resize(count);
  }
  mean.resize(count);
  variance.resize(count);
}

std::uint64_t next_geometry_id() {
  static std::atomic<std::uint64_t> last{0};
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace ppm
