#include <cmath>
#include <limits>
#include <numbers>

#include "framework/graph/registry.hpp"
#include "framework/roles/frame_filter.hpp"
#include "modules/sensor/incidence.hpp"

namespace {

using namespace ppm;

/// Noise of the first Kinect (structured light).
/// sigma       floor + quadratic (z - near)^2 along the optical axis; with `grazing`, beyond 60 degrees of incidence
///             also grazing_scale / sqrt(z) * (angle / (90 degrees - angle))^2
/// lateral_px  sigma_lateral pixels of an image with focal length `focal`, at this image's focal length. Nguyen et al.:
///             0.8 + 0.035 angle / (90 degrees - angle); it counts in proportion to the squared sine of the angle, and
///             so weighted it lies between 0.87 and 0.91 in every image of a kitchen, so one number serves all pixels.
/// source      Nguyen, Izadi, Lovell, "Modeling Kinect sensor noise for improved 3D reconstruction and tracking",
/// 3DIMPVT 2012
class Kinect final : public SensorModel {
 public:
  Kinect() {
    params_.add("sigma_floor", floor_).unit("m").above(0).doc("Depth noise at the distance sigma_near.");
    params_.add("sigma_quadratic", quadratic_)
        .range(0, 1)
        .doc("Growth of the depth noise with the square of the distance beyond sigma_near, 1/m.");
    params_.add("sigma_near", near_).unit("m").range(0, 10).doc("Distance of least depth noise.");
    params_.add("grazing", grazing_)
        .doc("Adds the noise of grazing views, from the angle of incidence that the image itself shows.");
    params_.add("grazing_scale", grazing_scale_).range(0, 1).doc("Size of the noise of grazing views, m^(3/2).");
    params_.add("normal_baseline", baseline_)
        .unit("rad")
        .range(1e-4, 0.5)
        .doc("Half the angle over which the surface's slope is taken.");
    params_.add("sigma_lateral", lateral_)
        .unit("px")
        .range(0, 10)
        .doc("Noise across the line of sight, in pixels of an image with focal length 'focal'.");
    params_.add("focal", focal_).unit("px").above(0).doc("Focal length to which sigma_lateral belongs.");
  }

  void set_noise(Frame& image) const override {
    image.lateral_px = static_cast<float>(lateral_ * std::abs(image.camera.fx) / focal_);
    image.sigma.resize(image.depth.size());
    for (std::size_t p = 0; p < image.depth.size(); ++p) {
      const float beyond = image.depth[p] - static_cast<float>(near_);
      image.sigma[p] = static_cast<float>(floor_) + static_cast<float>(quadratic_) * beyond * beyond;
    }
    if (grazing_) add_grazing(image);
  }

 private:
  void add_grazing(Frame& image) const {
    const auto cosine = incidence_cosine(image, baseline_);
    for (std::size_t p = 0; p < cosine.size(); ++p) {
      if (!(cosine[p] < kLargestCosine)) continue;  // also where it is not known
      const double angle = std::acos(std::max<double>(cosine[p], kLeastCosine));
      const double ratio = angle / (std::numbers::pi / 2 - angle);
      image.sigma[p] += static_cast<float>(grazing_scale_ / std::sqrt(image.depth[p]) * ratio * ratio);
    }
  }

  static constexpr float kLargestCosine = 0.5f;   // 60 degrees: where the term was seen to begin
  static constexpr float kLeastCosine = 0.0872f;  // 85 degrees: beyond what was measured; the term has a pole at 90
  double floor_ = 0.0012, quadratic_ = 0.0019, near_ = 0.4;
  bool grazing_ = true;
  double grazing_scale_ = 1e-4, baseline_ = std::numbers::pi / 180, lateral_ = 0.88, focal_ = 585;
};

}  // namespace

PPM_MODULES(r) {
  r.add<Kinect>("sensor.kinect", "Gives the depth and lateral noise of the first Kinect.",
                "Nguyen, Izadi, Lovell, 3DIMPVT 2012");
}
