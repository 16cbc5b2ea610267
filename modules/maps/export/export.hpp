#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/slam/map.hpp"
#include "modules/maps/picture/map_picture.hpp"

namespace ppm {

/// A file format of other programs.
enum class ExportFormat { ply, obj, glb, vdb, png };
/// The names on the command line, which are the files' endings.
const std::vector<std::pair<std::string, ExportFormat>>& export_formats();
/// The format that a file's ending names, in any case.
std::optional<ExportFormat> format_of(const std::filesystem::path& file);

struct ExportSettings {
  ExportFormat format = ExportFormat::ply;
  Surface surface = Surface::base;
  std::optional<Show> show;  ///< none: the map's own colour, or sigma where it has none
  double voxel_m = 0.02;     ///< vdb
  /// Of the camera, where it is known: tells which way is up. A GLB is turned to its own upwards, y, unless `up` is
  /// automatic and there is no path.
  std::vector<Pose> path;
  PictureSettings picture;  ///< png; `range` and `up` hold for all formats, `show` is set from above
};

struct ExportFile {
  std::filesystem::path path;
  std::string bytes;
};
struct Exported {
  std::vector<ExportFile> files;  ///< the one asked for last
  std::size_t vertices = 0, faces = 0;
  Show show = Show::shaded;         ///< what its colours say
  std::optional<ColorScale> scale;  ///< and how
};

/// The map as the bytes of `file`, and of the files that go with it (the texture and the material of an OBJ). The base
/// of a mesh map comes with its texture in OBJ and GLB; all else has colours at its vertices. Throws DataError, naming
/// `name`, where the map's own colour is wanted and it has none.
Exported export_map(const Map& map, const ExportSettings& settings, const std::filesystem::path& file,
                    const std::string& name);
/// Names of the files that export_map() would give.
std::vector<std::filesystem::path> export_names(const ExportSettings& settings, const std::filesystem::path& file);
/// Writes each file, atomically; the one asked for last.
void write(const Exported& exported);

}  // namespace ppm
