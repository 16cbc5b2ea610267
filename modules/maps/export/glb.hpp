#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

/// What nothing may be lost of: the texture of a chunk, exactly.
struct GlbTexels {
  std::vector<float> mean, variance;    ///< [T] m and m^2, face after face in the order of texel_index
  std::vector<float> excess;            ///< [F] m^2, see FaceEvidence
  std::vector<std::uint8_t> divisions;  ///< [F]
  std::vector<float> color, color_variance;  ///< [T*C] interleaved, [T]; empty where the map has none
};

/// One mesh of a file. Vertex arrays have one length; those that may be empty are left out then.
struct GlbMesh {
  std::string name;
  std::vector<Eigen::Vector3f> position, normal;
  std::vector<float> mean, sigma;                  ///< m; vertex attributes _MEAN and _SIGMA
  std::vector<Eigen::Vector2f> uv;                 ///< may be empty
  std::vector<Color> color;                        ///< may be empty
  std::vector<std::array<std::uint32_t, 3>> face;  ///< empty: each three vertices are a face
  std::string png;                                 ///< the texture; may be empty
  GlbTexels texels;                                ///< may be empty
};

struct GlbScene {
  std::vector<GlbMesh> meshes;
  Eigen::Quaternionf R_gltf_map = Eigen::Quaternionf::Identity();  ///< glTF has y upwards
  std::vector<std::pair<std::string, std::string>> notes;          ///< words in the scene's extras
  std::vector<std::pair<std::string, float>> numbers;              ///< numbers there
};

/// The bytes of a GLB file (glTF 2.0, binary). Faces are seen from their front only, so that one looks into a room
/// from outside. Raw texels stand in accessors that the mesh's extras name.
/// Source: Khronos Group, "glTF 2.0 Specification", ISO/IEC 12113:2022.
std::string to_glb(const GlbScene& scene);

}  // namespace ppm
