#pragma once
#include <memory>
#include <vector>

#include "framework/slam/frame.hpp"
#include "framework/slam/map.hpp"
#include "modules/maps/tsdf/tsdf_blocks.hpp"

namespace open3d::pipelines::integration {
class ScalableTSDFVolume;
}

namespace ppm {

struct TsdfSettings {
  double voxel_size_m = 0.02;
  double truncation_m = 0.08;  ///< signed distances are cut there
};

/// Map of kind "tsdf": Open3D's scalable volume, blocks of 16^3 voxels with a truncated signed distance and the number of
/// images that it is the mean of. Immutable behind its handle. A copy shares all blocks; integrate() clones those that it
/// writes and that another map has.
/// Source: Curless and Levoy, SIGGRAPH 1996; Zhou, Park, Koltun, "Open3D", 2018.
class TsdfMap final : public Map {
 public:
  static constexpr int kBlock = 16;  ///< voxels along a block's edge

  explicit TsdfMap(const TsdfSettings& settings);
  TsdfMap(const TsdfMap& other);  ///< shares blocks
  TsdfMap& operator=(const TsdfMap&) = delete;
  ~TsdfMap() override;

  /// Averages a frame into the volume. range_most_m: farther points are not used; 0: all are.
  void integrate(const Frame& frame, const Pose& T_map_camera, double range_most_m);

  const TsdfSettings& settings() const { return settings_; }
  const TsdfBlocks& blocks() const { return blocks_; }
  /// All blocks, by place (x, then y, then z).
  std::vector<TsdfBlocks::Entry> sorted_blocks() const;

  std::string_view kind() const override { return "tsdf"; }
  MapStats stats() const override;
  std::int64_t account(std::unordered_set<const void*>& seen) const override;
  void digest(Digest& digest) const override;
  /// Marching cubes between voxels that have all been seen, as Open3D extracts it; vertices and faces in a fixed order.
  Mesh mesh(Surface surface) const override;

  /// A block that holds these voxels, [16^3] each, z fastest. For codecs.
  static std::shared_ptr<TsdfBlock> make_block(const TsdfSettings& settings, const Eigen::Vector3i& place,
                                               const std::vector<float>& tsdf, const std::vector<float>& weight);
  /// [16^3] z fastest, of a block. For codecs.
  static void read_block(const TsdfBlock& block, std::vector<float>& tsdf, std::vector<float>& weight);
  void add_block(const Eigen::Vector3i& place, std::shared_ptr<TsdfBlock> block);
  /// To be called after the last add_block().
  void index_blocks();

 private:
  void own(const std::vector<Eigen::Vector3i>& places);
  std::int64_t table_bytes() const;

  TsdfSettings settings_;
  std::unique_ptr<open3d::pipelines::integration::ScalableTSDFVolume> volume_;
  TsdfBlocks blocks_;  // of volume_
};

}  // namespace ppm
