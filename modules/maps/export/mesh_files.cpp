#include "modules/maps/export/mesh_files.hpp"

#include <cmath>
#include <fmt/core.h>

#include "modules/maps/export/texel_colors.hpp"
#include "modules/maps/export/texture_atlas.hpp"
#include "modules/maps/picture/png_encoder.hpp"

namespace ppm {
namespace {

void add_vertex(const Mesh& mesh, std::uint32_t vertex, GlbMesh& out) {
  out.position.push_back(mesh.position[vertex]);
  out.normal.push_back(mesh.normal[vertex]);
  out.mean.push_back(mesh.mean[vertex]);
  out.sigma.push_back(std::sqrt(mesh.variance[vertex]));
}

GlbTexels raw_texels(const PpmChunk& chunk) {
  const Texels& texels = *chunk.texels;
  GlbTexels raw;
  raw.mean = texels.mean;
  raw.variance = texels.variance;
  raw.color = texels.color;
  raw.color_variance = texels.color_variance;
  raw.divisions = chunk.geometry->divisions;
  for (const auto& evidence : texels.evidence) raw.excess.push_back(evidence.excess);
  return raw;
}

}  // namespace

GlbMesh glb_mesh(const Mesh& mesh, const std::vector<Color>& color) {
  GlbMesh out;
  out.name = "surface";
  out.position = mesh.position;
  out.normal = mesh.normal;
  out.mean = mesh.mean;
  for (const float variance : mesh.variance) out.sigma.push_back(std::sqrt(variance));
  out.color = color;
  out.face = mesh.face;
  return out;
}

std::vector<GlbMesh> glb_chunks(const PpmMap& map, const Mesh& base, Show show,
                                const std::optional<ColorScale>& scale) {
  std::vector<GlbMesh> meshes;
  std::size_t face = 0;
  for (std::size_t c = 0; c < map.table().size(); ++c) {
    const PpmChunk& chunk = map.table()[c];
    const auto& divisions = chunk.geometry->divisions;
    if (divisions.empty()) continue;
    GlbMesh& out = meshes.emplace_back();
    const Cell& cell = map.table().cell(c);
    out.name = fmt::format("chunk {} {} {}", cell.x(), cell.y(), cell.z());
    for (std::size_t f = 0; f < divisions.size(); ++f, ++face)
      for (auto v : base.face[face]) add_vertex(base, v, out);
    out.texels = raw_texels(chunk);
    if (show == Show::shaded) continue;
    const TextureAtlas atlas(divisions);
    for (std::size_t f = 0; f < divisions.size(); ++f)
      for (const auto& uv : atlas.uv(f)) out.uv.push_back(uv);
    out.png = to_png(atlas.paint(texel_colors(chunk, show, scale)), PngEffort::fast);
  }
  return meshes;
}

ObjImage obj_image(const PpmMap& map, Show show, const std::optional<ColorScale>& scale) {
  std::vector<std::uint8_t> divisions;
  std::vector<Color> texels;
  for (const auto& chunk : map.table().chunks()) {
    const auto colors = texel_colors(chunk, show, scale);
    texels.insert(texels.end(), colors.begin(), colors.end());
    divisions.insert(divisions.end(), chunk.geometry->divisions.begin(), chunk.geometry->divisions.end());
  }
  const TextureAtlas atlas(divisions);
  ObjImage image;
  for (std::size_t f = 0; f < divisions.size(); ++f) image.uv.push_back(atlas.uv(f));
  image.png = to_png(atlas.paint(texels), PngEffort::fast);
  return image;
}

}  // namespace ppm
