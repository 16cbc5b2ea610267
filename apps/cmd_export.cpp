#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <map>
#include <memory>

#include "apps/commands.hpp"
#include "framework/config/units.hpp"
#include "framework/core/error.hpp"
#include "framework/slam/tum_trajectory.hpp"
#include "modules/maps/export/export.hpp"
#include "modules/maps/ppm/ppm_file.hpp"

namespace ppm {

namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  fs::path input, out;
  std::vector<ExportFormat> formats;
  std::optional<Surface> surface;
  std::optional<Show> show;
  std::vector<std::string> range;
  std::string voxel = "2 cm";
  Up up = Up::automatic;
  std::optional<std::int64_t> pose;
  int cols = 1280, rows = 960;
  bool edges = false, force = false, quiet = false;
};

double length_of(const std::string& option, const std::string& text) {
  double value = 0;
  if (const auto wrong = parse_quantity(text, "m", value); !wrong.empty()) throw ConfigError(Place{option}, wrong);
  return value;
}

/// map.ppm itself, or the one in the folder of a run.
fs::path map_file(const fs::path& input) {
  if (!fs::is_directory(input)) return input;
  if (!fs::exists(input / "map.ppm"))
    throw ConfigError(Place{input.string()}, "the folder holds no map.ppm (sink.map_ppm writes it)");
  return input / "map.ppm";
}

/// The camera's path, where the run left it beside the map.
std::vector<Pose> path_beside(const fs::path& map) {
  const auto file = map.parent_path() / "trajectory.tum";
  std::vector<Pose> path;
  if (!fs::exists(file)) return path;
  for (const auto& pose : read_tum(file)) path.push_back(pose.T_map_camera);
  return path;
}

std::optional<ScaleRange> range_of(const ExportOptions& o) {
  if (o.range.empty()) return std::nullopt;
  const ScaleRange range{static_cast<float>(length_of("--range", o.range[0])),
                         static_cast<float>(length_of("--range", o.range[1]))};
  if (range.low >= range.high) throw ConfigError(Place{"--range"}, "the lower end must be below the upper one");
  if (o.show.value_or(Show::sigma) == Show::sigma && range.low <= 0)
    throw ConfigError(Place{"--range"}, "the scale of sigma is logarithmic: its lower end must be positive");
  return range;
}

ExportSettings settings_of(const ExportOptions& o, std::vector<Pose> path) {
  ExportSettings settings;
  settings.show = o.show;
  settings.voxel_m = length_of("--voxel", o.voxel);
  if (settings.voxel_m <= 0) throw ConfigError(Place{"--voxel"}, "must be positive");
  settings.path = std::move(path);
  settings.picture.range = range_of(o);
  settings.picture.up = o.up;
  settings.picture.cols = o.cols;
  settings.picture.rows = o.rows;
  settings.picture.edges = o.edges;
  if (!o.pose) return settings;
  const auto poses = static_cast<std::int64_t>(settings.path.size());
  if (*o.pose >= poses)
    throw ConfigError(Place{"--pose"}, fmt::format("the path beside the map has {} poses, counted from 0", poses));
  settings.picture.T_map_camera = settings.path[static_cast<std::size_t>(*o.pose)];
  return settings;
}

/// What is asked for, or what suits the format: textures lie on the base, PLY, VDB and pictures have the texels as shape.
Surface surface_for(const ExportOptions& o, ExportFormat format) {
  if (o.surface) return *o.surface;
  return format == ExportFormat::obj || format == ExportFormat::glb ? Surface::base : Surface::displaced;
}

std::vector<ExportFormat> formats_of(const ExportOptions& o) {
  if (o.formats.size() > 1 && !o.out.empty())
    throw ConfigError(Place{"--out " + o.out.string()}, "names one file, but several formats are asked for");
  if (!o.formats.empty()) return o.formats;
  if (o.out.empty()) throw ConfigError({}, "say which format: --format ply, obj, glb, vdb or png");
  const auto format = format_of(o.out);
  if (!format)
    throw ConfigError(Place{"--out " + o.out.string()},
                      "the ending names no format (ply, obj, glb, vdb, png): say --format");
  return {*format};
}

fs::path default_name(const fs::path& map, ExportFormat format, Surface surface) {
  for (const auto& [ending, f] : export_formats())
    if (f == format)
      return map.parent_path() / fmt::format("{}_{}.{}", map.stem().string(),
                                             surface == Surface::base ? "base" : "displaced", ending);
  return {};
}

void refuse_to_replace(const ExportSettings& settings, const fs::path& file) {
  for (const auto& name : export_names(settings, file))
    if (fs::exists(name)) throw ConfigError(Place{name.string()}, "exists already; --force replaces it");
}

std::string summary(const Exported& exported) {
  std::string text;
  for (const auto& file : exported.files)
    text += fmt::format("{} ({:.1f} MB)\n", file.path.string(), static_cast<double>(file.bytes.size()) / 1e6);
  text += fmt::format("  {} vertices, {} faces", exported.vertices, exported.faces);
  if (exported.scale)
    text += fmt::format("; colours: {} from {} to {}, {}", exported.scale->title(),
                        length_text(exported.scale->range().low), length_text(exported.scale->range().high),
                        exported.scale->logarithmic() ? "logarithmic" : "linear");
  return text + "\n";
}

void run_export(const ExportOptions& o) {
  const auto formats = formats_of(o);
  const fs::path file = map_file(o.input);
  ExportSettings settings = settings_of(o, path_beside(file));
  for (const bool dry : {true, false}) {  // no file is written where one of them may not be
    std::shared_ptr<const PpmMap> map;
    if (!dry) map = load_ppm(file);
    for (const auto format : formats) {
      settings.format = format;
      settings.surface = surface_for(o, format);
      const auto out = o.out.empty() ? default_name(file, format, settings.surface) : o.out;
      if (dry && !o.force) refuse_to_replace(settings, out);
      if (dry) continue;
      const Exported exported = export_map(*map, settings, out, file.string());
      write(exported);
      if (!o.quiet) fmt::print("{}", summary(exported));
    }
  }
}

}  // namespace

void add_export(CLI::App& app) {
  auto* command = app.add_subcommand("export", "Writes a map as a mesh, a distance field or a picture for other programs");
  auto o = std::make_shared<ExportOptions>();
  auto choice = [](const auto& names) {
    using Value = typename std::decay_t<decltype(names)>::value_type::second_type;
    return CLI::CheckedTransformer(std::map<std::string, Value>(names.begin(), names.end()));
  };
  command->add_option("map", o->input, "A map.ppm, or the folder of a run that holds one")->required()->type_name("PATH");
  command->add_option("--format", o->formats, "ply, obj, glb, vdb or png; several with commas between them")
      ->delimiter(',')
      ->transform(choice(export_formats()));
  command
      ->add_option("--surface", o->surface,
                   "base: the faces, with their texture in obj and glb; displaced: a vertex for each texel, moved by "
                   "its mean. Default: base for obj and glb, displaced for the others")
      ->transform(choice(std::vector<std::pair<std::string, Surface>>{{"base", Surface::base},
                                                                      {"displaced", Surface::displaced}}));
  command
      ->add_option("--show", o->show,
                   "What colours say: sigma (standard deviation of the surface), mean (its offset from the faces), "
                   "normal, color, or shaded (nothing). Default: the map's colour, or sigma")
      ->transform(choice(show_names()));
  command->add_option("--range", o->range, "Ends of the colour scale, '1 mm' '5 cm' (default: the map's own)")
      ->expected(2)
      ->type_name("LOW HIGH");
  command->add_option("--voxel", o->voxel, "vdb: edge of a voxel")->capture_default_str()->type_name("LENGTH");
  command->add_option("--up", o->up, "The map's axis that is up: auto (from the path beside the map), x, -x, y, -y, z, -z")
      ->transform(choice(up_names()));
  command->add_option("--pose", o->pose, "png: seen from this pose of the path, counted from 0 (default: from outside)")
      ->check(CLI::NonNegativeNumber)
      ->type_name("N");
  command->add_option("--cols", o->cols, "png: width")->check(CLI::Range(16, 8192))->capture_default_str();
  command->add_option("--rows", o->rows, "png: height")->check(CLI::Range(16, 8192))->capture_default_str();
  command->add_flag("--edges", o->edges, "png: draw the edges of faces");
  command->add_option("--out", o->out, "File to write (default: beside the map, map_SURFACE.FORMAT); its ending may name the format")
      ->type_name("FILE");
  command->add_flag("--force", o->force, "Replace files that exist");
  command->add_flag("--quiet", o->quiet, "Say nothing");
  command->callback([o] { run_export(*o); });
}

}  // namespace ppm
