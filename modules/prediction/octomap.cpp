#include "framework/graph/registry.hpp"
#include "framework/roles/view_predictor.hpp"
#include "modules/maps/octomap/octomap_map.hpp"
#include "modules/maps/octomap/octomap_surface.hpp"

namespace {

using namespace ppm;

/// What a camera should see of an octree: the first occupied cell of each pixel's ray, and a likelihood that OctoMap itself
/// does not have (docs/maps_grids.md).
class OctomapPrediction final : public ViewPredictor {
 public:
  OctomapPrediction() : ViewPredictor("map.octomap") {
    params_
        .add_choice("surface", place_,
                    {{"centre", OctomapPlace::centre},
                     {"face", OctomapPlace::face},
                     {"middle", OctomapPlace::middle}})
        .doc(
            "Where the surface is taken to be: centre is the first occupied cell's centre, as OctoMap's castRay says, face is "
            "where the ray enters that cell, middle is halfway through the run of occupied cells that begins with it.");
    params_.add("sigma_cells", sigma_cells_)
        .range(0.01, 10)
        .doc("Standard deviation of the surface about that place, along the normal, in cells ...");
    params_.add("sigma_least", sigma_least_m_)
        .unit("m")
        .range(0, 1)
        .doc("... and what is left however small they are: errors of poses and of the sensor's scale.");
    params_.add("range_most", range_most_m_).unit("m").above(0).doc("Cells farther away are not seen.");
  }

  void prepare(const std::vector<const Map*>&, const Workers&) override {}

  void predict(const Map& map, const Rows& rows, Prediction& out, int) const override {
    const auto& octree = static_cast<const OctomapMap&>(map);
    OctomapSurface surface(octree.tree(), place_);
    const double in_cell_m = sigma_cells_ * octree.resolution_m();
    const auto variance = static_cast<float>(in_cell_m * in_cell_m + sigma_least_m_ * sigma_least_m_);
    const Eigen::Vector3d origin = out.T_map_camera.translation();
    const auto cols = static_cast<std::size_t>(out.camera.cols);
    for (auto i = static_cast<std::size_t>(rows.first) * cols; i < static_cast<std::size_t>(rows.end) * cols; ++i) {
      const Eigen::Vector3d direction = out.direction(i);
      const auto point = surface.look(origin, direction, range_most_m_);
      if (!point || point->range_m <= 0) continue;
      out.range[i] = static_cast<float>(point->range_m);
      out.variance[i] = variance;
      out.chunk[i] = out.face[i] = 0;
      Eigen::Map<Eigen::Vector3f>(&out.normal[3 * i]) = towards_camera(point->normal, direction.cast<float>());
    }
  }

 private:
  static Eigen::Vector3f towards_camera(const Eigen::Vector3f& normal, const Eigen::Vector3f& direction) {
    if (normal.isZero()) return -direction;
    return normal.dot(direction) > 0 ? Eigen::Vector3f(-normal) : normal;
  }

  OctomapPlace place_ = OctomapPlace::middle;
  double sigma_cells_ = 0.4;
  double sigma_least_m_ = 0.01;
  double range_most_m_ = 20;
};

}  // namespace

PPM_MODULES(r) {
  r.add<OctomapPrediction>("prediction.octomap", "Predicts what a camera sees of an octree by casting rays through it.",
                           "Hornung et al. 2013; Amanatides and Woo 1987");
}
