#include "modules/maps/vdb/occupancy_update.hpp"

#include <algorithm>

#include "modules/maps/vdb/ray_marks.hpp"
#include "modules/maps/vdb/tile_writer.hpp"
#include "modules/maps/vdb/visible_tiles.hpp"

namespace ppm {
namespace {

/// Writes what an image says into tiles.
class ProfileWriter {
 public:
  ProfileWriter(const TileWriter& writer, const PixelProfiles& profiles, const Pose& T_map_camera, double voxel_size_m)
      : writer_(writer), profiles_(profiles), T_camera_voxel_(T_map_camera.inverse() * Eigen::Scaling(voxel_size_m)) {
    const Camera& camera = profiles.camera;
    look_.fx = static_cast<float>(camera.fx), look_.fy = static_cast<float>(camera.fy);
    look_.cx = static_cast<float>(camera.cx + 0.5), look_.cy = static_cast<float>(camera.cy + 0.5);
    look_.cols = camera.cols, look_.rows = camera.rows;
    look_.pixel = &profiles.pixel.data()->depth;
    look_.hit = profiles.hit, look_.miss = profiles.miss;
    for (int axis = 0; axis < 3; ++axis)
      Eigen::Map<Eigen::Vector3f>(look_.step[axis]) = T_camera_voxel_.linear().col(axis).cast<float>();
  }

  void write(std::uint32_t chunk, const SeenTile& seen) const {
    if (!writer_.chunk(chunk).tile && seen.free == kAllLeaves) return writer_.add(chunk, profiles_.miss);
    for (int leaf = 0; leaf < kVdbTileLeaves; ++leaf) {
      if (seen.free >> leaf & 1) writer_.add(chunk, leaf, profiles_.miss);
      if (seen.mixed >> leaf & 1) write_voxels(chunk, leaf, seen.no_hits >> leaf & 1);
    }
    writer_.settle(chunk);
  }

 private:
  void write_voxels(std::uint32_t chunk, int leaf, bool no_hits) const {
    LeafCodes before;
    const bool constant = writer_.read(chunk, leaf, before);
    if (constant && no_hits && before[0] == static_cast<VdbCode>(writer_.how().least)) return;
    LeafLook look = look_;
    const Eigen::Vector3d centre = writer_.origin(chunk, leaf).cast<double>().array() + 0.5;
    Eigen::Map<Eigen::Vector3f>(look.origin) = (T_camera_voxel_ * centre).cast<float>();
    LeafCodes after = before;
    look_at_leaf(look, writer_.how(), after.data());
    writer_.write(chunk, leaf, before, after);
  }

  const TileWriter& writer_;
  const PixelProfiles& profiles_;
  Eigen::Affine3d T_camera_voxel_;  // of coordinates in voxels
  LeafLook look_;                   // but for the leaf's origin
};

/// Writes the voxels that rays have marked.
void write_marks(const TileWriter& writer, const PixelProfiles& profiles, std::uint32_t chunk,
                 const RayMarks::Tile& marks) {
  for (int leaf = 0; leaf < kVdbTileLeaves; ++leaf) {
    const auto first = static_cast<std::size_t>(leaf * kVdbLeafVoxels);
    LeafCodes before;
    writer.read(chunk, leaf, before);
    LeafCodes after = before;
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (marks.hit[first + i])
        after[i] = writer.sum(before[i], profiles.hit);
      else if (marks.passed[first + i])
        after[i] = writer.sum(before[i], profiles.miss);
    }
    writer.write(chunk, leaf, before, after);
  }
  writer.settle(chunk);
}

}  // namespace

void OccupancyView::build(const Frame& frame, const VdbMap& map, const OccupancySettings& settings) {
  profiles.build(frame, map, settings);
  form = settings.form;
  if (form == OccupancyForm::literal)
    ends = ray_ends(frame, settings.max_range_m);
  else
    bounds.build(profiles);
}

std::shared_ptr<const VdbMap> update_occupancy(std::shared_ptr<const VdbMap> map, const OccupancyView& view,
                                               const Pose& T_map_camera, const Workers& workers) {
  const double h = map->settings().voxel_size_m;
  VdbEdit edit(std::move(map));
  const TileWriter writer(edit, view.profiles.keep);
  std::vector<std::uint32_t> chunk;
  if (view.form == OccupancyForm::literal) {
    const RayMarks marks(view.ends, T_map_camera, h);
    for (const auto& tile : marks.tiles()) chunk.push_back(edit.chunk(tile.cell));
    workers.for_each(chunk.size(),
                     [&](std::size_t i, int) { write_marks(writer, view.profiles, chunk[i], marks.tiles()[i]); });
  } else {
    const auto seen = seen_tiles(view.profiles, view.bounds, T_map_camera, h);
    for (const auto& tile : seen) chunk.push_back(edit.chunk(tile.cell));
    const ProfileWriter profile(writer, view.profiles, T_map_camera, h);
    workers.for_each(chunk.size(), [&](std::size_t i, int) { profile.write(chunk[i], seen[i]); });
  }
  return edit.commit();
}

}  // namespace ppm
