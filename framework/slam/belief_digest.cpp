#include "framework/slam/belief_digest.hpp"

#include <unordered_map>
#include <vector>

namespace ppm {

namespace {

void add_pose(Digest& digest, const Pose& pose) {
  digest.add(pose.data(), 16 * sizeof(double));
}

/// The digest of each distinct map, computed in parallel.
std::unordered_map<const Map*, std::string> map_digests(const std::vector<MapHandle>& maps, const Workers& workers) {
  std::unordered_map<const Map*, std::string> digests;
  for (const auto& map : maps) digests.try_emplace(map.get());
  std::vector<std::pair<const Map*, std::string*>> work;
  for (auto& [map, hex] : digests) work.emplace_back(map, &hex);
  workers.for_each(work.size(), [&](std::size_t i, int) {
    Digest digest;
    if (work[i].first) work[i].first->digest(digest);
    *work[i].second = digest.hex();
  });
  return digests;
}

}  // namespace

std::string belief_digest(const ParticleSet& belief, const Workers& workers) {
  const auto maps = map_digests(belief.map, workers);
  Digest digest;
  digest.add(belief.size());
  for (std::size_t i = 0; i < belief.size(); ++i) {
    add_pose(digest, belief.pose[i]);
    digest.add(belief.log_weight[i]);
    const auto path = belief.trajectory[i].poses();
    digest.add(path.size());
    for (const auto& p : path) {
      digest.add(p.frame);
      digest.add(p.stamp_s);
      add_pose(digest, p.T_map_camera);
    }
    digest.add(maps.at(belief.map[i].get()));
  }
  return digest.hex();
}

}  // namespace ppm
