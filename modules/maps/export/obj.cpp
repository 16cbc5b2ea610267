#include "modules/maps/export/obj.hpp"

#include <fmt/format.h>
#include <iterator>

namespace ppm {

std::string to_obj(const Mesh& mesh, const std::vector<Color>& color, const ObjTexture* texture) {
  std::string text = "# metres\n";
  auto out = std::back_inserter(text);
  if (texture) fmt::format_to(out, "mtllib {}\n", texture->material_file);
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    const auto& p = mesh.position[v];
    fmt::format_to(out, "v {:.5f} {:.5f} {:.5f}", p.x(), p.y(), p.z());
    if (!color.empty()) fmt::format_to(out, " {:.3f} {:.3f} {:.3f}", color[v].x(), color[v].y(), color[v].z());
    text += '\n';
  }
  for (const auto& n : mesh.normal) fmt::format_to(out, "vn {:.4f} {:.4f} {:.4f}\n", n.x(), n.y(), n.z());
  if (texture) {
    for (const auto& corners : texture->uv)
      for (const auto& uv : corners) fmt::format_to(out, "vt {:.6f} {:.6f}\n", uv.x(), 1 - uv.y());
    text += "usemtl map\n";
  }
  for (std::size_t f = 0; f < mesh.face.size(); ++f) {
    const auto [a, b, c] = mesh.face[f];
    if (texture)
      fmt::format_to(out, "f {}/{}/{} {}/{}/{} {}/{}/{}\n", a + 1, 3 * f + 1, a + 1, b + 1, 3 * f + 2, b + 1, c + 1,
                     3 * f + 3, c + 1);
    else
      fmt::format_to(out, "f {}//{} {}//{} {}//{}\n", a + 1, a + 1, b + 1, b + 1, c + 1, c + 1);
  }
  return text;
}

std::string to_mtl(const std::string& image_file) {
  return fmt::format("newmtl map\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd {}\n", image_file);
}

}  // namespace ppm
