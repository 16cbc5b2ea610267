#include "modules/maps/tsdf/tsdf_map.hpp"

#include <omp.h>
#include <open3d/geometry/Image.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/geometry/RGBDImage.h>
#include <open3d/pipelines/integration/ScalableTSDFVolume.h>
#include <open3d/pipelines/integration/UniformTSDFVolume.h>

#include <algorithm>
#include <set>

#include "framework/core/only_handle.hpp"

namespace ppm {

namespace {

using open3d::camera::PinholeCameraIntrinsic;
using open3d::geometry::PointCloud;
using open3d::geometry::RGBDImage;
using open3d::pipelines::integration::ScalableTSDFVolume;
using open3d::pipelines::integration::TSDFVolumeColorType;

constexpr int kSampling = 4;  // blocks are opened around each n-th point of each n-th row: the library's default

std::unique_ptr<ScalableTSDFVolume> make_volume(const TsdfSettings& s) {
  return std::make_unique<ScalableTSDFVolume>(s.voxel_size_m, s.truncation_m, TSDFVolumeColorType::NoColor,
                                              TsdfMap::kBlock, kSampling);
}

/// Depth as the library takes it: m, 0 where there is none.
RGBDImage depth_image(const Frame& frame, double range_most_m) {
  const Camera& c = frame.camera;
  RGBDImage image;
  image.depth_.Prepare(c.cols, c.rows, 1, sizeof(float));
  auto* depth = reinterpret_cast<float*>(image.depth_.data_.data());
  for (int i = 0; i < c.pixels(); ++i) {
    const float d = frame.valid(i) ? frame.depth[static_cast<std::size_t>(i)] : 0.0f;
    depth[i] = range_most_m > 0 && d > range_most_m ? 0.0f : d;
  }
  return image;
}

/// Keeps the library's own loops on the calling thread: particles are what this framework divides among threads.
class OneThread {
 public:
  OneThread() : levels_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
  ~OneThread() { omp_set_max_active_levels(levels_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int levels_;
};

bool before(const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// The blocks that ScalableTSDFVolume::Integrate writes: those within the truncation of a sampled point.
std::vector<Eigen::Vector3i> blocks_to_write(const ScalableTSDFVolume& volume, const PointCloud& points) {
  std::set<Eigen::Vector3i, decltype(&before)> places(&before);
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(volume.sdf_trunc_);
  for (const auto& p : points.points_) {
    const Eigen::Vector3i low = ((p - reach) / volume.volume_unit_length_).array().floor().cast<int>();
    const Eigen::Vector3i high = ((p + reach) / volume.volume_unit_length_).array().floor().cast<int>();
    for (int x = low.x(); x <= high.x(); ++x)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int z = low.z(); z <= high.z(); ++z) places.insert({x, y, z});
  }
  return {places.begin(), places.end()};
}

std::int64_t bytes_of(const TsdfBlock& block) {
  return static_cast<std::int64_t>(sizeof block + block.voxels_.capacity() * sizeof(block.voxels_[0]));
}

}  // namespace

TsdfMap::TsdfMap(const TsdfSettings& settings) : settings_(settings), volume_(make_volume(settings)) {}

TsdfMap::TsdfMap(const TsdfMap& other) : Map(other), settings_(other.settings_), volume_(make_volume(other.settings_)) {
  volume_->volume_units_ = other.volume_->volume_units_;
  blocks_ = other.blocks_;
}

TsdfMap::~TsdfMap() = default;

void TsdfMap::integrate(const Frame& frame, const Pose& T_map_camera, double range_most_m) {
  const OneThread here;
  const Camera& c = frame.camera;
  const PinholeCameraIntrinsic intrinsic(c.cols, c.rows, c.fx, c.fy, c.cx, c.cy);
  const Eigen::Matrix4d T_camera_map = T_map_camera.inverse().matrix();
  const auto image = depth_image(frame, range_most_m);
  const auto points = PointCloud::CreateFromDepthImage(image.depth_, intrinsic, T_camera_map, 1, 1e9, kSampling);
  own(blocks_to_write(*volume_, *points));
  volume_->Integrate(image, intrinsic, T_camera_map);
  index_blocks();
}

void TsdfMap::own(const std::vector<Eigen::Vector3i>& places) {
  for (const auto& place : places) {
    const auto unit = volume_->volume_units_.find(place);
    if (unit == volume_->volume_units_.end() || !unit->second.volume_) continue;
    auto& block = unit->second.volume_;
    if (!is_only_handle(block)) block = std::make_shared<TsdfBlock>(*block);
  }
}

void TsdfMap::index_blocks() {
  blocks_ = TsdfBlocks(sorted_blocks());
}

std::vector<TsdfBlocks::Entry> TsdfMap::sorted_blocks() const {
  std::vector<TsdfBlocks::Entry> blocks;
  for (const auto& [place, unit] : volume_->volume_units_)
    if (unit.volume_) blocks.emplace_back(place, unit.volume_.get());
  std::ranges::sort(blocks, [](const auto& a, const auto& b) { return before(a.first, b.first); });
  return blocks;
}

std::int64_t TsdfMap::table_bytes() const {
  const auto& units = volume_->volume_units_;
  using Unit = std::remove_reference_t<decltype(*units.begin())>;
  const auto node = sizeof(Unit) + 2 * sizeof(void*);  // its link and hash
  return static_cast<std::int64_t>(sizeof *this + sizeof *volume_ + units.size() * node +
                                   units.bucket_count() * sizeof(void*)) +
         blocks_.bytes();
}

MapStats TsdfMap::stats() const {
  MapStats stats;
  stats.chunks = static_cast<std::int64_t>(volume_->volume_units_.size());
  stats.bytes = table_bytes();
  for (const auto& [place, unit] : volume_->volume_units_)
    if (unit.volume_) stats.bytes += bytes_of(*unit.volume_);
  return stats;
}

std::int64_t TsdfMap::account(std::unordered_set<const void*>& seen) const {
  std::int64_t bytes = seen.insert(this).second ? table_bytes() : 0;
  for (const auto& [place, unit] : volume_->volume_units_)
    if (unit.volume_ && seen.insert(unit.volume_.get()).second) bytes += bytes_of(*unit.volume_);
  return bytes;
}

void TsdfMap::digest(Digest& digest) const {
  digest.add(settings_.voxel_size_m);
  digest.add(settings_.truncation_m);
  std::vector<float> tsdf, weight;
  for (const auto& [place, block] : sorted_blocks()) {
    for (int axis = 0; axis < 3; ++axis) digest.add(place[axis]);
    read_block(*block, tsdf, weight);
    digest.add(tsdf);
    digest.add(weight);
  }
}

std::shared_ptr<TsdfBlock> TsdfMap::make_block(const TsdfSettings& settings, const Eigen::Vector3i& place,
                                               const std::vector<float>& tsdf, const std::vector<float>& weight) {
  const double edge_m = settings.voxel_size_m * kBlock;
  auto block = std::make_shared<TsdfBlock>(edge_m, kBlock, settings.truncation_m, TSDFVolumeColorType::NoColor,
                                           place.cast<double>() * edge_m);
  for (std::size_t i = 0; i < block->voxels_.size(); ++i) {
    block->voxels_[i].tsdf_ = tsdf[i];
    block->voxels_[i].weight_ = weight[i];
  }
  return block;
}

void TsdfMap::read_block(const TsdfBlock& block, std::vector<float>& tsdf, std::vector<float>& weight) {
  tsdf.clear();
  weight.clear();
  for (const auto& voxel : block.voxels_) {
    tsdf.push_back(voxel.tsdf_);
    weight.push_back(voxel.weight_);
  }
}

void TsdfMap::add_block(const Eigen::Vector3i& place, std::shared_ptr<TsdfBlock> block) {
  auto& unit = volume_->volume_units_[place];
  unit.volume_ = std::move(block);
  unit.index_ = place;
}

}  // namespace ppm
