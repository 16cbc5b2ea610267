#include "modules/prediction/vdb_view.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {

namespace {

/// The rays of a camera in a map, and what they meet. Keeps the leaves around the last rays at hand.
class Caster {
 public:
  Caster(const VdbMap& map, const VoxelRayOptions& options, const Prediction& view, const RayStarts& starts,
         const Eigen::Array3f& low, const Eigen::Array3f& high)
      : options_(options), camera_(view.camera), starts_(starts), low_(low), high_(high), leaves_(map) {
    const auto per_metre = static_cast<float>(1 / map.settings().voxel_size_m);
    R_ = view.T_map_camera.linear().cast<float>();
    origin_ = view.T_map_camera.translation().cast<float>() * per_metre;
  }

  /// Follows the ray of a pixel; false at a miss.
  bool cast(int x, int y) {
    hit_ = {};
    const float start = starts_.of(x, y);
    if (start == std::numeric_limits<float>::infinity()) return false;
    ray_ = VoxelRay::make(origin_, R_ * camera_.ray(x, y).normalized().cast<float>());
    if (ray_.clip(low_, high_)) hit_ = trace(ray_, options_, leaves_, start);
    return hit_.hit();
  }
  const VoxelHit& hit() const { return hit_; }
  Eigen::Vector3f normal() { return normal_of(ray_, hit_, options_, leaves_); }
  /// |normal . ray|, at least Prediction::kMinCosine.
  float cosine(const Eigen::Vector3f& normal) const {
    return std::max(std::abs(normal.dot(ray_.direction)), static_cast<float>(Prediction::kMinCosine));
  }

 private:
  const VoxelRayOptions& options_;
  const Camera& camera_;
  const RayStarts& starts_;
  const Eigen::Array3f &low_, &high_;
  VoxelLeaves leaves_;
  Eigen::Matrix3f R_;
  Eigen::Vector3f origin_;
  VoxelRay ray_{};
  VoxelHit hit_;
};

/// A voxel's number in its tile: by leaves, then by voxels.
std::uint32_t tile_voxel(const Cell& v) {
  return static_cast<std::uint32_t>(vdb_leaf(v.x(), v.y(), v.z()) * kVdbLeafVoxels + vdb_voxel(v.x(), v.y(), v.z()));
}

}  // namespace

void VdbView::start(const VdbMap& map, const VoxelRayOptions& options, const Prediction& view) {
  map_ = &map;
  starts_.build(map, view.camera, view.T_map_camera);
  options_ = options;
  const auto& table = map.table();
  Eigen::Array3i low = Eigen::Array3i::Zero(), high = low;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Eigen::Array3i cell = table.cell(i).array();
    low = i == 0 ? cell : low.min(cell).eval();
    high = i == 0 ? (cell + 1).eval() : high.max(cell + 1).eval();
  }
  low_ = (low * kVdbTileEdge).cast<float>();
  high_ = (high * kVdbTileEdge).cast<float>();
}

void VdbView::sample(const Prediction& view, std::span<const std::uint32_t> pixels, ViewSamples& out) const {
  Caster caster(*map_, options_, view, starts_, low_, high_);
  const auto size = static_cast<float>(map_->settings().voxel_size_m);
  const auto cols = static_cast<std::uint32_t>(view.camera.cols);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    out.range[i] = Prediction::kMiss, out.variance[i] = 0, out.cosine[i] = 1;
    if (!caster.cast(static_cast<int>(pixels[i] % cols), static_cast<int>(pixels[i] / cols))) continue;
    out.range[i] = caster.hit().range * size;
    out.variance[i] = caster.hit().variance * size * size;
    out.cosine[i] = caster.cosine(caster.normal());
  }
}

// In blocks of pixels, whose rays pass the same leaves.
void VdbView::fill(const Prediction& view, const Rows& rows, Prediction& out) const {
  constexpr int kBlock = 8;
  Caster caster(*map_, options_, view, starts_, low_, high_);
  const auto size = static_cast<float>(map_->settings().voxel_size_m);
  const int cols = view.camera.cols;
  auto pixel = [&](int x, int y) {
    if (!caster.cast(x, y)) return;
    const auto p = static_cast<std::size_t>(y * cols + x);
    const VoxelHit& hit = caster.hit();
    const Eigen::Vector3f normal = caster.normal();
    const float c = caster.cosine(normal);
    out.range[p] = hit.range * size;
    out.variance[p] = hit.variance * size * size * c * c;
    for (int k = 0; k < 3; ++k) out.normal[3 * p + static_cast<std::size_t>(k)] = normal[k];
    out.chunk[p] = hit.chunk;
    out.face[p] = tile_voxel(hit.voxel);
  };
  for (int y0 = rows.first; y0 < rows.end; y0 += kBlock)
    for (int x0 = 0; x0 < cols; x0 += kBlock)
      for (int y = y0; y < std::min(y0 + kBlock, rows.end); ++y)
        for (int x = x0; x < std::min(x0 + kBlock, cols); ++x) pixel(x, y);
}

void VdbView::elements(const Prediction& view, const Rows& rows, std::span<std::uint32_t> chunk,
                       std::span<std::uint32_t> face) const {
  Caster caster(*map_, options_, view, starts_, low_, high_);
  std::size_t i = 0;
  for (int y = rows.first; y < rows.end; ++y)
    for (int x = 0; x < view.camera.cols; ++x, ++i) {
      const bool hit = caster.cast(x, y);
      chunk[i] = hit ? caster.hit().chunk : Prediction::kNone;
      face[i] = hit ? tile_voxel(caster.hit().voxel) : Prediction::kNone;
    }
}

}  // namespace ppm
