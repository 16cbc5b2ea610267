#pragma once
#include <optional>

#include "modules/maps/export/glb.hpp"
#include "modules/maps/export/obj.hpp"
#include "modules/maps/picture/color_scale.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// A mesh with colours at its vertices ([V] or empty) as the one mesh of a GLB file.
GlbMesh glb_mesh(const Mesh& mesh, const std::vector<Color>& color);
/// The base of a mesh map, one GLB mesh a chunk: (V, F, T) as the paper has it, each with its own texture (none for
/// Show::shaded) and its texels exactly.
std::vector<GlbMesh> glb_chunks(const PpmMap& map, const Mesh& base, Show show, const std::optional<ColorScale>& scale);

/// The texture of the base of a mesh map for an OBJ file: one image for all faces. show: not Show::shaded.
struct ObjImage {
  std::vector<std::array<Eigen::Vector2f, 3>> uv;  ///< [F]
  std::string png;
};
ObjImage obj_image(const PpmMap& map, Show show, const std::optional<ColorScale>& scale);

}  // namespace ppm
