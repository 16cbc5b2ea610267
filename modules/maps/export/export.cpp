#include "modules/maps/export/export.hpp"

#include <algorithm>
#include <cctype>

#include "framework/core/atomic_file.hpp"
#include "framework/core/error.hpp"
#include "modules/maps/export/mesh_files.hpp"
#include "modules/maps/export/ply.hpp"
#include "modules/maps/export/vdb.hpp"
#include "modules/maps/picture/path_drawing.hpp"
#include "modules/maps/picture/png_encoder.hpp"

namespace ppm {
namespace {

namespace fs = std::filesystem;

std::string name_of(Surface surface) {
  return surface == Surface::base ? "base" : "displaced";
}

GlbScene glb_scene(const Mesh& mesh, const ExportSettings& settings, const Exported& about) {
  GlbScene scene;
  if (settings.picture.up != Up::automatic || !settings.path.empty()) {
    const Eigen::Vector3d up = up_direction(settings.picture.up, mesh, settings.path);
    scene.R_gltf_map.setFromTwoVectors(up.cast<float>(), Eigen::Vector3f::UnitY());
  }
  scene.notes = {{"unit", "m"}, {"surface", name_of(settings.surface)}, {"colors", to_string(about.show)}};
  if (about.scale) {
    scene.notes.push_back({"scale", about.scale->logarithmic() ? "logarithmic" : "linear"});
    scene.numbers = {{"scale_low", about.scale->range().low}, {"scale_high", about.scale->range().high}};
  }
  return scene;
}

/// The mesh map behind the interface where its base is wanted: only that has a texture.
const PpmMap* textured(const Map& map, Surface surface) {
  return surface == Surface::base ? dynamic_cast<const PpmMap*>(&map) : nullptr;
}

void add_glb(const Map& map, const Mesh& mesh, const ExportSettings& settings, const fs::path& file, Exported& out) {
  GlbScene scene = glb_scene(mesh, settings, out);
  if (const auto* ppm = textured(map, settings.surface))
    scene.meshes = glb_chunks(*ppm, mesh, out.show, out.scale);
  else
    scene.meshes.push_back(glb_mesh(mesh, vertex_colors(mesh, out.show, out.scale)));
  out.files.push_back({file, to_glb(scene)});
}

void add_obj(const Map& map, const Mesh& mesh, const ExportSettings& settings, const fs::path& file, Exported& out) {
  const auto* ppm = textured(map, settings.surface);
  if (!ppm || out.show == Show::shaded) {
    out.files.push_back({file, to_obj(mesh, vertex_colors(mesh, out.show, out.scale), nullptr)});
    return;
  }
  auto names = export_names(settings, file);
  ObjImage image = obj_image(*ppm, out.show, out.scale);
  const ObjTexture texture{std::move(image.uv), names[1].filename().string()};
  out.files.push_back({names[0], std::move(image.png)});
  out.files.push_back({names[1], to_mtl(names[0].filename().string())});
  out.files.push_back({file, to_obj(mesh, {}, &texture)});
}

void add_png(const Mesh& mesh, const ExportSettings& settings, const fs::path& file, Exported& out) {
  PictureSettings picture = settings.picture;
  picture.show = out.show;
  const auto draw = [&](Canvas& canvas) { draw_path(canvas, settings.path, picture.rows / 960.0); };
  const bool outside = !picture.T_map_camera;
  out.files.push_back({file, to_png(map_picture(mesh, settings.path, picture,
                                                outside ? std::function<void(Canvas&)>(draw) : nullptr))});
}

}  // namespace

const std::vector<std::pair<std::string, ExportFormat>>& export_formats() {
  static const std::vector<std::pair<std::string, ExportFormat>> formats{
      {"ply", ExportFormat::ply}, {"obj", ExportFormat::obj}, {"glb", ExportFormat::glb}, {"vdb", ExportFormat::vdb},
      {"png", ExportFormat::png}};
  return formats;
}

std::optional<ExportFormat> format_of(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const auto& [name, format] : export_formats())
    if (ending == "." + name) return format;
  return std::nullopt;
}

Exported export_map(const Map& map, const ExportSettings& settings, const fs::path& file, const std::string& name) {
  const Mesh mesh = map.mesh(settings.surface);
  Exported out;
  out.vertices = mesh.position.size();
  out.faces = mesh.face.size();
  if (settings.format == ExportFormat::vdb) {
    out.files.push_back({file, to_vdb(mesh, settings.voxel_m)});
    return out;
  }
  out.show = settings.show ? *settings.show : mesh.color.empty() ? Show::sigma : Show::color;
  if (out.show == Show::color && mesh.color.empty() && !mesh.position.empty())
    throw DataError(name, "has no colour to show");
  out.scale = scale_for(mesh, out.show, settings.picture.range);
  if (settings.format == ExportFormat::glb) add_glb(map, mesh, settings, file, out);
  if (settings.format == ExportFormat::obj) add_obj(map, mesh, settings, file, out);
  if (settings.format == ExportFormat::png) add_png(mesh, settings, file, out);
  if (settings.format == ExportFormat::ply)
    out.files.push_back({file, to_ply(mesh, vertex_colors(mesh, out.show, out.scale))});
  return out;
}

std::vector<fs::path> export_names(const ExportSettings& settings, const fs::path& file) {
  if (settings.format != ExportFormat::obj || settings.surface != Surface::base) return {file};
  const std::string stem = fs::path(file).replace_extension().string();
  return {stem + "_texture.png", stem + ".mtl", file};
}

void write(const Exported& exported) {
  for (const auto& file : exported.files) write_file(file.path, file.bytes);
}

}  // namespace ppm
