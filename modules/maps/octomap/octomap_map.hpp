#pragma once
#include <memory>
#include <mutex>

#include "framework/core/record.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/map.hpp"

namespace octomap {
class OcTree;
}

namespace ppm {

/// OctoMap's sensor model, as probabilities.
struct OctomapSensor {
  double hit = 0.7, miss = 0.4;                     ///< that a cell is occupied, where a ray ends in it or goes through it
  double clamp_least = 0.1192, clamp_most = 0.971;  ///< no cell becomes surer than this
};

/// How a frame is written into an OctoMap.
struct OctomapInsertion {
  OctomapSensor sensor;
  double range_most_m = 0;   ///< longer rays are cut there and leave no hit; 0: none are
  bool discretize = false;   ///< one ray for all points of a cell
  int stride = 1;            ///< inserts each n-th pixel of each n-th row
};

/// Map of kind "octomap": an octree of log odds that a cell is occupied. Immutable behind its handle. The library's trees
/// share no nodes, so that an edit copies the tree unless its handle is the only one.
/// Source: Hornung, Wurm, Bennewitz, Stachniss, Burgard, "OctoMap", Autonomous Robots 2013.
class OctomapMap final : public Map {
 public:
  /// occupied: probability from which a cell counts as occupied.
  OctomapMap(double resolution_m, double occupied);
  OctomapMap(const OctomapMap& other);  ///< deep
  OctomapMap& operator=(const OctomapMap&) = delete;
  ~OctomapMap() override;

  /// Writes what a frame shows from a pose, by OcTree::insertPointCloud.
  void insert(const Frame& frame, const Pose& T_map_camera, const OctomapInsertion& how);

  const octomap::OcTree& tree() const { return *tree_; }
  double resolution_m() const;
  std::string_view kind() const override { return "octomap"; }
  MapStats stats() const override;
  std::int64_t account(std::unordered_set<const void*>& seen) const override;
  void digest(Digest& digest) const override;
  /// The faces of occupied cells towards free ones. Vertices at the corners of cells.
  Mesh mesh(Surface surface) const override;

 private:
  friend void save(RecordWriter& out, const OctomapMap& map);
  friend std::shared_ptr<OctomapMap> load_octomap(RecordReader& in);
  std::int64_t bytes() const;

  std::unique_ptr<octomap::OcTree> tree_;
  mutable std::mutex counting_;
  mutable std::int64_t bytes_ = -1;  // of tree_ as it is; -1: not counted yet
};

void save(RecordWriter& out, const OctomapMap& map);
std::shared_ptr<OctomapMap> load_octomap(RecordReader& in);

}  // namespace ppm
