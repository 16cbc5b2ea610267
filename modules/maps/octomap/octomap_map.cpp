#include "modules/maps/octomap/octomap_map.hpp"

#include <octomap/OcTree.h>

#include <sstream>

namespace ppm {

namespace {

octomap::point3d point(const Eigen::Vector3d& p) {
  const Eigen::Vector3f f = p.cast<float>();
  return {f.x(), f.y(), f.z()};
}

/// The values of all nodes, depth first, children in order: the library's own format.
std::string nodes_of(const octomap::OcTree& tree) {
  std::ostringstream out;
  tree.writeData(out);
  return out.str();
}

}  // namespace

OctomapMap::OctomapMap(double resolution_m, double occupied) : tree_(std::make_unique<octomap::OcTree>(resolution_m)) {
  tree_->setOccupancyThres(occupied);
}

OctomapMap::OctomapMap(const OctomapMap& other) : Map(other), tree_(std::make_unique<octomap::OcTree>(*other.tree_)) {}

OctomapMap::~OctomapMap() = default;

void OctomapMap::insert(const Frame& frame, const Pose& T_map_camera, const OctomapInsertion& how) {
  tree_->setProbHit(how.sensor.hit);
  tree_->setProbMiss(how.sensor.miss);
  tree_->setClampingThresMin(how.sensor.clamp_least);
  tree_->setClampingThresMax(how.sensor.clamp_most);
  octomap::Pointcloud cloud;
  cloud.reserve(static_cast<std::size_t>(frame.camera.pixels()));
  for (int y = 0; y < frame.camera.rows; y += how.stride)
    for (int x = 0; x < frame.camera.cols; x += how.stride) {
      const int i = y * frame.camera.cols + x;
      if (!frame.valid(i)) continue;
      cloud.push_back(point(T_map_camera * (frame.camera.ray(x, y) * frame.depth[static_cast<std::size_t>(i)])));
    }
  constexpr double kUncut = -1;
  tree_->insertPointCloud(cloud, point(T_map_camera.translation()), how.range_most_m > 0 ? how.range_most_m : kUncut,
                          false, how.discretize);
  bytes_ = -1;
}

double OctomapMap::resolution_m() const {
  return tree_->getResolution();
}

std::int64_t OctomapMap::bytes() const {
  const std::lock_guard lock(counting_);
  if (bytes_ < 0) bytes_ = static_cast<std::int64_t>(tree_->memoryUsage() + sizeof *this);
  return bytes_;
}

MapStats OctomapMap::stats() const {
  MapStats stats;
  stats.bytes = bytes();
  return stats;
}

std::int64_t OctomapMap::account(std::unordered_set<const void*>& seen) const {
  return seen.insert(this).second ? bytes() : 0;
}

void OctomapMap::digest(Digest& digest) const {
  digest.add(tree_->getResolution());
  digest.add(tree_->getOccupancyThres());
  digest.add(nodes_of(*tree_));
}

void save(RecordWriter& out, const OctomapMap& map) {
  out.add(map.tree_->getResolution());
  out.add(map.tree_->getOccupancyThres());
  out.add(nodes_of(*map.tree_));
}

std::shared_ptr<OctomapMap> load_octomap(RecordReader& in) {
  const auto resolution_m = in.take<double>();
  auto map = std::make_shared<OctomapMap>(resolution_m, in.take<double>());
  const auto nodes = in.take<std::string>();
  if (nodes.empty()) return map;
  std::istringstream stream(nodes);
  map->tree_->readData(stream);
  if (!stream || nodes_of(*map->tree_) != nodes) in.fail("holds no octree");
  return map;
}

}  // namespace ppm
