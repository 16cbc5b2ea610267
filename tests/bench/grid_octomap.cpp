// grid_octomap RESOLUTION_M SOURCE PARAMS: OctoMap on the frames of a source, for the curve of error against bytes.
// Hornung et al., "OctoMap", Autonomous Robots 2013; its defaults for hits, misses and clamping.
#include <octomap/OcTree.h>

#include "tests/bench/grid_bench.hpp"

namespace {

using namespace ppm;

class OctoMap {
 public:
  explicit OctoMap(double resolution_m) : tree_(resolution_m) {}

  void integrate(const Frame& frame) {
    const Pose& T = *frame.T_world_camera_ref;
    octomap::Pointcloud cloud;
    for (int y = 0, i = 0; y < frame.camera.rows; ++y)
      for (int x = 0; x < frame.camera.cols; ++x, ++i) {
        if (!frame.valid(i)) continue;
        const Eigen::Vector3f p =
            (T * (frame.camera.ray(x, y) * frame.depth[static_cast<std::size_t>(i)])).cast<float>();
        cloud.push_back(p.x(), p.y(), p.z());
      }
    tree_.insertPointCloud(cloud, point(T.translation()));
  }

  Prediction predict(const Camera& camera, const Pose& T_map_camera) {
    Prediction out;
    out.reset(camera, 1, T_map_camera);
    const double variance = tree_.getResolution() * tree_.getResolution() / 12;
    for (std::size_t i = 0; i < out.range.size(); ++i) {
      const Eigen::Vector3d direction = out.direction(i);
      octomap::point3d end;
      if (!tree_.castRay(point(T_map_camera.translation()), point(direction), end, true, 10)) continue;
      const Eigen::Vector3d centre(end.x(), end.y(), end.z());
      bench::set_hit(out, i, (centre - T_map_camera.translation()).dot(direction), direction, variance);
    }
    return out;
  }

  std::int64_t bytes() const { return static_cast<std::int64_t>(tree_.memoryUsage()); }

 private:
  static octomap::point3d point(const Eigen::Vector3d& p) {
    const Eigen::Vector3f f = p.cast<float>();
    return {f.x(), f.y(), f.z()};
  }
  octomap::OcTree tree_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: grid_octomap RESOLUTION_M SOURCE PARAMS\n"), 2;
  const double resolution_m = std::stod(argv[1]);
  OctoMap map(resolution_m);
  return bench::map_and_score("OctoMap", resolution_m, map, argv[2], argv[3]);
}
