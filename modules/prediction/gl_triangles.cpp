#include "modules/prediction/gl_triangles.hpp"

namespace ppm {

GlTriangles::GlTriangles(const Geometry& geometry) {
  constexpr std::uint32_t kNone = Geometry::kNoVertex;
  const std::size_t faces = geometry.face.size();
  position.reserve(faces);
  std::vector<std::uint32_t> copy(geometry.position.size(), kNone);  // by the chunk's vertex: one of its copies here
  std::vector<std::uint8_t> last(faces, 2);                          // the corner that stands for the face
  for (std::size_t f = 0; f < faces; ++f) {
    for (std::uint8_t corner = 0; corner < 3; ++corner)
      if (copy[geometry.face[f][corner]] == kNone) last[f] = corner;
    const std::uint32_t vertex = geometry.face[f][last[f]];
    if (copy[vertex] == kNone) copy[vertex] = static_cast<std::uint32_t>(f);
    position.push_back(geometry.position[vertex]);
  }
  for (std::size_t v = 0; v < copy.size(); ++v) {
    if (copy[v] != kNone) continue;
    copy[v] = static_cast<std::uint32_t>(position.size());
    position.push_back(geometry.position[v]);
  }
  face.reserve(faces);
  for (std::size_t f = 0; f < faces; ++f) {
    const auto& corners = geometry.face[f];
    const std::size_t first = (last[f] + 1u) % 3, second = (last[f] + 2u) % 3;
    face.push_back({copy[corners[first]], copy[corners[second]], static_cast<std::uint32_t>(f)});
  }
}

}  // namespace ppm
