#include "framework/graph/registry.hpp"
#include "framework/roles/view_predictor.hpp"
#include "modules/maps/tsdf/tsdf_map.hpp"
#include "modules/maps/tsdf/tsdf_surface.hpp"

namespace {

using namespace ppm;

/// What a camera should see of a volume of signed distances: where each pixel's ray passes zero, and a likelihood that
/// Open3D does not have: a voxel is the mean of so many images, whose errors are in part common (docs/maps_grids.md).
class TsdfPrediction final : public ViewPredictor {
 public:
  TsdfPrediction() : ViewPredictor("map.tsdf") {
    params_.add("sigma_image", sigma_image_m_)
        .unit("m")
        .range(0, 1)
        .doc("Standard deviation, along the normal, that one image brings and that averages out over images.");
    params_.add("sigma_least", sigma_least_m_)
        .unit("m")
        .range(0.0001, 1)
        .doc("Standard deviation that is left however many images there are: errors of poses and of the sensor's scale.");
    params_.add("range_most", range_most_m_).unit("m").above(0).doc("Surface farther away is not seen.");
  }

  void prepare(const std::vector<const Map*>&, const Workers&) override {}

  void predict(const Map& map, const Rows& rows, Prediction& out, int) const override {
    TsdfSurface surface(static_cast<const TsdfMap&>(map));
    const Eigen::Vector3d origin = out.T_map_camera.translation();
    const auto cols = static_cast<std::size_t>(out.camera.cols);
    for (auto i = static_cast<std::size_t>(rows.first) * cols; i < static_cast<std::size_t>(rows.end) * cols; ++i) {
      const Eigen::Vector3d direction = out.direction(i);
      const auto point = surface.look(origin, direction, range_most_m_);
      if (!point) continue;
      out.range[i] = static_cast<float>(point->range_m);
      out.variance[i] = variance(point->weight);
      out.chunk[i] = out.face[i] = 0;
      Eigen::Map<Eigen::Vector3f>(&out.normal[3 * i]) = towards_camera(point->normal, direction.cast<float>());
    }
  }

 private:
  float variance(float weight) const {
    const double images = std::max(1.0, static_cast<double>(weight));
    return static_cast<float>(sigma_image_m_ * sigma_image_m_ / images + sigma_least_m_ * sigma_least_m_);
  }
  static Eigen::Vector3f towards_camera(const Eigen::Vector3f& normal, const Eigen::Vector3f& direction) {
    if (normal.isZero()) return -direction;
    return normal.dot(direction) > 0 ? Eigen::Vector3f(-normal) : normal;
  }

  double sigma_image_m_ = 0.01;
  double sigma_least_m_ = 0.008;
  double range_most_m_ = 20;
};

}  // namespace

PPM_MODULES(r) {
  r.add<TsdfPrediction>("prediction.tsdf", "Predicts what a camera sees of a volume of signed distances.",
                        "Curless and Levoy 1996; Newcombe et al. 2011 (KinectFusion), section 3.3");
}
