#include "apps/module_templates.hpp"

namespace ppm {

const char* const kSensorTemplate = R"(#include "framework/graph/registry.hpp"
#include "framework/roles/frame_filter.hpp"

namespace {

using namespace ppm;

/// Say here what the noise of the sensor depends on, and who measured it: now it is a share of the depth.
class NewModule final : public SensorModel {
 public:
  NewModule() { params_.add("share", share_).above(0).doc("Standard deviation of a depth, as a share of it."); }

  void set_noise(Frame& image) const override {
    image.sigma.resize(image.depth.size());
    for (std::size_t p = 0; p < image.depth.size(); ++p) image.sigma[p] = static_cast<float>(share_) * image.depth[p];
  }

 private:
  double share_ = 0.005;
};

}  // namespace

PPM_MODULES(r) {
  r.add<NewModule>("category.name", "Gives noise in proportion to the depth.", "Where the noise was measured.");
}
)";

const char* const kPreprocessTemplate = R"(#include <limits>

#include "framework/graph/registry.hpp"
#include "framework/roles/frame_filter.hpp"

namespace {

using namespace ppm;

/// Say here which pixels are dropped or changed: now those that are too near.
class NewModule final : public Preprocessing {
 public:
  NewModule() { params_.add("least", least_).unit("m").range(0, 100).doc("Nearer depths are dropped."); }

 protected:
  void apply(Frame& image, const Workers&) const override {
    for (std::size_t p = 0; p < image.depth.size(); ++p)
      if (image.depth[p] < static_cast<float>(least_))
        image.depth[p] = image.sigma[p] = std::numeric_limits<float>::quiet_NaN();
  }

 private:
  double least_ = 0.5;
};

}  // namespace

PPM_MODULES(r) {
  r.add<NewModule>("category.name", "Drops near pixels.", "Where the method is described.");
}
)";

}  // namespace ppm
