#include "modules/maps/export/ply.hpp"

#include <cmath>
#include <fmt/core.h>

#include "modules/maps/export/bytes.hpp"

namespace ppm {
namespace {

std::string header_of(const Mesh& mesh, bool colored) {
  std::string header =
      "ply\nformat binary_little_endian 1.0\n"
      "comment metres; mean and standard deviation of the surface's offset along the normal\n";
  header += fmt::format("element vertex {}\n", mesh.position.size());
  for (const char* property : {"x", "y", "z", "nx", "ny", "nz", "mean", "sigma"})
    header += fmt::format("property float {}\n", property);
  if (colored)
    for (const char* property : {"red", "green", "blue"}) header += fmt::format("property uchar {}\n", property);
  return header +
         fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.face.size());
}

}  // namespace

std::string to_ply(const Mesh& mesh, const std::vector<Color>& color) {
  std::string bytes = header_of(mesh, !color.empty());
  bytes.reserve(bytes.size() + 35 * mesh.position.size() + 13 * mesh.face.size());
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    const float sigma = std::sqrt(mesh.variance[v]);
    append(bytes, mesh.position[v].data(), 3);
    append(bytes, mesh.normal[v].data(), 3);
    append(bytes, &mesh.mean[v], 1);
    append(bytes, &sigma, 1);
    if (!color.empty()) append(bytes, to_bytes(color[v]).data(), 3);
  }
  for (const auto& face : mesh.face) {
    bytes.push_back(3);
    append(bytes, face.data(), 3);
  }
  return bytes;
}

}  // namespace ppm
