// grid_tsdf VOXEL_M SOURCE PARAMS: Open3D's scalable TSDF on the frames of a source, for the curve of error against
// bytes. Curless and Levoy, SIGGRAPH 1996; Zhou et al., "Open3D", 2018. Truncation at four voxels, at least 4 cm; the
// mesh that it extracts is what predicts.
#include <open3d/geometry/Image.h>
#include <open3d/geometry/RGBDImage.h>
#include <open3d/geometry/TriangleMesh.h>
#include <open3d/pipelines/integration/ScalableTSDFVolume.h>
#include <open3d/pipelines/integration/UniformTSDFVolume.h>

#include "modules/maps/ppm/face_grid.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"
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
    if (!faces_) extract();
    Prediction out;
    out.reset(camera, 1, T_map_camera);
    for (std::size_t i = 0; i < out.range.size(); ++i) {
      const Eigen::Vector3d direction = out.direction(i);
      const auto hit = faces_->first_hit(T_map_camera.translation(), direction, 0, 20);
      if (hit) bench::set_hit(out, i, hit->range, direction, voxel_m_ * voxel_m_ / 12);
    }
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
    PpmEdit edit(std::make_shared<const PpmMap>(PpmSettings{}));
    std::vector<std::uint32_t> id;
    for (const auto& v : mesh->vertices_) id.push_back(edit.add_vertex(v.cast<float>()));
    const std::vector<float> zero(texel_count(1), 0.0f), one(texel_count(1), 1.0f);
    auto corner = [&](int v) { return id[static_cast<std::size_t>(v)]; };
    for (const auto& t : mesh->triangles_) edit.add_face({corner(t[0]), corner(t[1]), corner(t[2])}, 1, {zero, one});
    surface_ = edit.commit();
    faces_ = std::make_unique<FaceGrid>(*surface_, std::max(2 * voxel_m_, 0.03));
  }

  double voxel_m_;
  open3d::pipelines::integration::ScalableTSDFVolume volume_;
  std::shared_ptr<const PpmMap> surface_;
  std::unique_ptr<FaceGrid> faces_;  // of surface_
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: grid_tsdf VOXEL_M SOURCE PARAMS\n"), 2;
  const double voxel_m = std::stod(argv[1]);
  Tsdf map(voxel_m);
  return bench::map_and_score("TSDF", voxel_m, map, argv[2], argv[3]);
}
