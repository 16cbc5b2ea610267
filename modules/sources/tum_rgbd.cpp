#include "framework/graph/registry.hpp"
#include "framework/roles/frame_source.hpp"
#include "modules/sources/tum_sequence.hpp"

namespace ppm {
namespace {

/// A sequence in the layout of the TUM RGB-D benchmark, or of ICL-NUIM in that layout (fy < 0: image rows grow
/// against y).
/// frame   depth in m (0 and 65535: no return), stamp of the depth image, color if asked for, reference pose from
///         groundtruth.txt where there is one near enough in time
/// throws  DataError naming file and line or frame: no lists, malformed lines, missing or broken images
/// source  Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012
class TumRgbd final : public FrameSource {
 public:
  TumRgbd() {
    params_.add("path", settings_.path)
        .required()
        .doc("The folder. A leading ${PPM_DATA} is replaced by that environment variable, or by ../shared/data.");
    const auto not_zero = [](const double& f) {
      return [&f] { return f == 0 ? std::string("must not be 0") : std::string(); };
    };
    params_.add("fx", settings_.fx).unit("px").above(0).doc("Focal length along image rows.");
    params_.add("fy", settings_.fy)
        .unit("px")
        .check(not_zero(settings_.fy))
        .doc(
            "Focal length along image columns; negative where image rows grow against the camera's y axis (ICL-NUIM).");
    params_.add("cx", settings_.cx).unit("px").doc("Column of the principal point; pixel centres are at integers.");
    params_.add("cy", settings_.cy).unit("px").doc("Row of the principal point.");
    params_.add("depth_scale", settings_.depth_scale).above(0).doc("Depth units of the image per metre.");
    params_.add("max_dt", settings_.max_dt_s)
        .unit("s")
        .range(0, 10)
        .doc(
            "Largest difference in time between a depth image and the colour image or reference pose that goes with "
            "it.");
    params_.add("color", settings_.color).doc("Also read the colour images.");
  }

 private:
  std::unique_ptr<const FrameSequence> open_sequence() const override {
    return std::make_unique<TumSequence>(settings_);
  }

  TumSettings settings_;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::TumRgbd>("source.tum_rgbd",
                      "Reads depth images and poses in the layout of the TUM RGB-D benchmark, also ICL-NUIM.",
                      "Sturm et al., IROS 2012");
}
