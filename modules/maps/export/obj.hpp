#pragma once
#include <array>
#include <string>
#include <vector>

#include "framework/slam/mesh.hpp"
#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

/// Texture coordinates of each face's corners (v downwards), and the names of the files that go with them.
struct ObjTexture {
  std::vector<std::array<Eigen::Vector2f, 3>> uv;  ///< [F]
  std::string material_file;                       ///< name only: it lies beside the OBJ file
};

/// The text of an OBJ file. color: [V] or empty; written behind the positions, which most programs read as vertex
/// colours. texture: or nullptr.
/// Source: Wavefront, "Advanced Visualizer: object files (.obj)", 1995.
std::string to_obj(const Mesh& mesh, const std::vector<Color>& color, const ObjTexture* texture);
/// The text of the material file of a textured OBJ.
std::string to_mtl(const std::string& image_file);

}  // namespace ppm
