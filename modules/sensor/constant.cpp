#include <limits>

#include "framework/graph/registry.hpp"
#include "framework/roles/frame_filter.hpp"

namespace {

using namespace ppm;

/// The same noise for all pixels at all distances: the simplest model, and the yardstick for the others.
class Constant final : public SensorModel {
 public:
  Constant() {
    params_.add("sigma", sigma_).unit("m").above(0).doc("Standard deviation of every depth.");
    params_.add("sigma_lateral", lateral_)
        .unit("px")
        .range(0, 10)
        .doc("Noise across the line of sight, in pixels of this image.");
  }

  void set_noise(Frame& image) const override {
    image.lateral_px = static_cast<float>(lateral_);
    image.sigma.assign(image.depth.size(), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t p = 0; p < image.depth.size(); ++p)
      if (image.depth[p] == image.depth[p]) image.sigma[p] = static_cast<float>(sigma_);
  }

 private:
  double sigma_ = 0.006, lateral_ = 0.5;
};

}  // namespace

PPM_MODULES(r) {
  r.add<Constant>("sensor.constant", "Gives every pixel the same noise.", "paper, section 4.3 (sensor variance)");
}
