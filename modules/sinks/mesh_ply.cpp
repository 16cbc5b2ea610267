#include <bit>
#include <string>

#include "framework/core/atomic_file.hpp"
#include "framework/graph/registry.hpp"
#include "framework/slam/particle_set.hpp"
#include "modules/sinks/output_name.hpp"

static_assert(std::endian::native == std::endian::little, "the PLY file is written from memory as it is");

namespace ppm {
namespace {

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

std::string ply_header(const Mesh& mesh) {
  std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment metres; mean and variance of the offset along the normal\n";
  header += fmt::format("element vertex {}\n", mesh.position.size());
  for (const char* property : {"x", "y", "z", "nx", "ny", "nz", "mean", "variance"})
    header += fmt::format("property float {}\n", property);
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.face.size());
  return header;
}

std::string to_ply(const Mesh& mesh) {
  std::string bytes = ply_header(mesh);
  bytes.reserve(bytes.size() + 32 * mesh.position.size() + 13 * mesh.face.size());
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    append(bytes, mesh.position[v].data(), 3);
    append(bytes, mesh.normal[v].data(), 3);
    append(bytes, &mesh.mean[v], 1);
    append(bytes, &mesh.variance[v], 1);
  }
  for (const auto& face : mesh.face) {
    bytes.push_back(3);
    append(bytes, face.data(), 3);
  }
  return bytes;
}

/// Writes the best particle's map as a mesh whenever the node runs.
class MeshPly final : public Module {
 public:
  In<Belief> belief{this, {{"belief", "map.*"}, {}, {}}};

  MeshPly() {
    params_.add("file", file_).doc(kOutputNameDoc);
    params_.add_choice("surface", surface_, {{"base", Surface::base}, {"displaced", Surface::displaced}})
        .doc("The elements as they are, or moved by the means of their texels: the surface that the map describes.");
  }

  void tick(Context& context) override {
    const Mesh mesh = belief->map[belief->best()]->mesh(surface_);
    write_file(context.output(output_name(file_, context.frame())), to_ply(mesh));
  }

 private:
  std::string file_ = "map.ply";
  Surface surface_ = Surface::displaced;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::MeshPly>("sink.mesh_ply",
                      "Writes the best particle's map as a PLY mesh with normals, mean and variance per vertex.",
                      "Turk, \"The PLY polygon file format\", 1994");
}
