#include "framework/roles/seen_surface.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_set>

namespace ppm {

namespace {

using Points = std::vector<Eigen::Vector3f>;

constexpr std::size_t kImages = 100;
constexpr float kVoxel = 0.01f;  // m

/// At most kImages of the mapped images that have a pose.
std::vector<std::int64_t> looks(const FrameSource& source, std::int64_t last) {
  auto path = source.reference(last);
  std::erase_if(path, [&](const StampedPose& p) { return !std::ranges::binary_search(source.selected(), p.frame); });
  const std::size_t n = std::min(path.size(), kImages);
  std::vector<std::int64_t> some;
  for (std::size_t k = 0; k < n; ++k) some.push_back(path[k * path.size() / n].frame);
  return some;
}

Points seen_in(const Frame& frame, const TrueSurface& truth) {
  const Pose& T_world_camera = *frame.T_world_camera_ref;
  Points direction;
  for (int y = 0; y < frame.camera.rows; ++y)
    for (int x = 0; x < frame.camera.cols; ++x)
      if (frame.valid(y * frame.camera.cols + x))
        direction.push_back((T_world_camera.linear() * frame.camera.ray(x, y).normalized()).cast<float>());
  std::vector<float> range(direction.size());
  truth.cast(T_world_camera.translation(), direction, range);
  const Eigen::Vector3f origin = T_world_camera.translation().cast<float>();
  Points seen;
  for (std::size_t i = 0; i < range.size(); ++i)
    if (std::isfinite(range[i])) seen.emplace_back(origin + range[i] * direction[i]);
  return seen;
}

/// Number of the voxel that a point lies in, distinct for all within 10 km.
std::uint64_t voxel_of(const Eigen::Vector3f& p) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::int64_t>(std::floor(p[axis] / kVoxel));
    key = key << 21 | (static_cast<std::uint64_t>(cell) & 0x1fffff);
  }
  return key;
}

}  // namespace

Points seen_surface(const TrueSurface& truth, const FrameSource& source, std::int64_t last, const Workers& workers) {
  const auto images = looks(source, last);
  Points points;
  std::unordered_set<std::uint64_t> voxels;
  // In batches: rays are cast in parallel, and voxels filled in order.
  std::vector<Points> batch(2 * static_cast<std::size_t>(workers.threads()));
  for (std::size_t first = 0; first < images.size(); first += batch.size()) {
    const std::size_t n = std::min(batch.size(), images.size() - first);
    workers.for_each(n, [&](std::size_t i, int) { batch[i] = seen_in(source.full_frame(images[first + i]), truth); });
    for (std::size_t i = 0; i < n; ++i)
      std::ranges::copy_if(batch[i], std::back_inserter(points),
                           [&](const Eigen::Vector3f& p) { return voxels.insert(voxel_of(p)).second; });
  }
  return points;
}

}  // namespace ppm
