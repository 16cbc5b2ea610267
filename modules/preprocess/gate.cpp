#include <limits>

#include "framework/core/error.hpp"
#include "framework/graph/registry.hpp"
#include "framework/roles/frame_filter.hpp"

namespace {

using namespace ppm;

/// Drops pixels that are too near, too far, too uncertain or too faint.
/// throws  DataError where confidence_least is set and the frame has no confidence
class Gate final : public Preprocessing {
 public:
  Gate() {
    params_.add("min_range", min_range_).unit("m").range(0, kNoLimit).doc("Nearer depths are dropped.");
    params_.add("max_range", max_range_).unit("m").above(0).doc("Farther depths are dropped.");
    params_.add("sigma_most", sigma_most_)
        .unit("m")
        .above(0)
        .doc("Depths with a larger standard deviation are dropped.");
    params_.add("confidence_least", confidence_least_)
        .range(0, kNoLimit)
        .doc("Pixels with less confidence are dropped, in the sensor's own units; 0 keeps all.");
  }

 protected:
  void apply(Frame& image, const Workers&) const override {
    if (confidence_least_ > 0 && image.confidence.empty())
      throw DataError(
          "the frames", image.index,
          "have no confidence, which 'confidence_least' asks for; set it to 0, or use a source that has it");
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t p = 0; p < image.depth.size(); ++p) {
      const bool kept = image.depth[p] >= min_range_ && image.depth[p] <= max_range_ && image.sigma[p] <= sigma_most_ &&
                        !(confidence_least_ > 0 && !(image.confidence[p] >= confidence_least_));
      if (!kept) image.depth[p] = image.sigma[p] = nan;
    }
  }

 private:
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  double min_range_ = 0, max_range_ = 1000, sigma_most_ = 1000, confidence_least_ = 0;
};

}  // namespace

PPM_MODULES(r) {
  r.add<Gate>("preprocess.gate", "Drops pixels by range, noise and confidence.",
              "May et al., Journal of Field Robotics 26(11), 2009 (amplitude and distance filters)");
}
