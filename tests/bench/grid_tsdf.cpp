// grid_tsdf VOXEL_M SOURCE PARAMS: Open3D's scalable TSDF on the frames of a source, for the curve of error against
// bytes. Curless and Levoy, SIGGRAPH 1996; Zhou et al., "Open3D", 2018. Truncation at four voxels, at least 4 cm; the
// mesh that it extracts is what predicts.
#include <open3d/geometry/Image.h>
#include <open3d/geometry/RGBDImage.h>
#include <open3d/geometry/TriangleMesh.h>
#include <open3d/pipelines/integration/ScalableTSDFVolume.h>
#include <open3d/pipelines/integration/UniformTSDFVolume.h>
#include <open3d/t/geometry/RaycastingScene.h>

#include "tests/bench/grid_bench.hpp"

namespace {

using namespace ppm;

class Tsdf {
 public:
  explicit Tsdf(double voxel_m)
      : voxel_m_(voxel_m),
        volume_(voxel_m, std::max(4 * voxel_m, 0.04), open3d::pipelines::integration::TSDFVolumeColorType::NoColor) {}

  void integrate(const Frame& frame) {
    const Camera& c = frame.camera;
    open3d::geometry::RGBDImage image;
    image.depth_.Prepare(c.cols, c.rows, 1, 4);
    auto* depth = reinterpret_cast<float*>(image.depth_.data_.data());
    for (int i = 0; i < c.pixels(); ++i) depth[i] = frame.valid(i) ? frame.depth[static_cast<std::size_t>(i)] : 0.0f;
    const open3d::camera::PinholeCameraIntrinsic intrinsic(c.cols, c.rows, c.fx, c.fy, c.cx, c.cy);
    volume_.Integrate(image, intrinsic, frame.T_world_camera_ref->inverse().matrix());
  }

  Prediction predict(const Camera& camera, const Pose& T_map_camera) {
    if (!ready_) extract();
    Prediction out;
    out.reset(camera, 1, T_map_camera);
    const auto n = static_cast<std::int64_t>(out.range.size());
    auto rays = open3d::core::Tensor::Zeros({n, 6}, open3d::core::Float32);
    auto* ray = rays.GetDataPtr<float>();
    for (std::size_t i = 0; i < out.range.size(); ++i) {
      const Eigen::Vector3d direction = out.direction(i);
      for (int k = 0; k < 3; ++k) {
        ray[6 * i + static_cast<std::size_t>(k)] = static_cast<float>(T_map_camera.translation()[k]);
        ray[6 * i + 3 + static_cast<std::size_t>(k)] = static_cast<float>(direction[k]);
      }
    }
    const auto hits = scene_.CastRays(rays)["t_hit"].Contiguous();
    const auto* range = hits.GetDataPtr<float>();
    for (std::size_t i = 0; i < out.range.size(); ++i)
      if (std::isfinite(range[i])) bench::set_hit(out, i, range[i], out.direction(i), voxel_m_ * voxel_m_ / 12);
    return out;
  }

  std::int64_t bytes() const {
    constexpr std::int64_t kVoxels = 16 * 16 * 16;  // of a block
    return static_cast<std::int64_t>(volume_.volume_units_.size()) * kVoxels *
           static_cast<std::int64_t>(sizeof(open3d::geometry::TSDFVoxel));
  }

 private:
  void extract() {
    const auto mesh = volume_.ExtractTriangleMesh();
    std::vector<float> vertices;
    std::vector<std::uint32_t> triangles;
    for (const auto& v : mesh->vertices_)
      for (int k = 0; k < 3; ++k) vertices.push_back(static_cast<float>(v[k]));
    for (const auto& t : mesh->triangles_)
      for (int k = 0; k < 3; ++k) triangles.push_back(static_cast<std::uint32_t>(t[k]));
    scene_.AddTriangles(
        open3d::core::Tensor(vertices, {static_cast<std::int64_t>(vertices.size() / 3), 3}, open3d::core::Float32),
        open3d::core::Tensor(triangles, {static_cast<std::int64_t>(triangles.size() / 3), 3}, open3d::core::UInt32));
    ready_ = true;
  }

  double voxel_m_;
  open3d::pipelines::integration::ScalableTSDFVolume volume_;
  open3d::t::geometry::RaycastingScene scene_;
  bool ready_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: grid_tsdf VOXEL_M SOURCE PARAMS\n"), 2;
  const double voxel_m = std::stod(argv[1]);
  Tsdf map(voxel_m);
  return bench::map_and_score("TSDF", voxel_m, map, argv[2], argv[3]);
}
