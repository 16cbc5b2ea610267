#include "framework/graph/registry.hpp"
#include "framework/roles/frame_source.hpp"
#include "modules/sources/sr4000_sequence.hpp"

namespace ppm {
namespace {

/// Images of a SwissRanger SR4000 time-of-flight camera, as text.
/// frame   176x144 depth along the optical axis, without the lens' distortion; confidence is the amplitude; stamp index
/// /
///         rate; no poses
/// throws  DataError naming file and frame: no such folder, no images, blocks that are missing or broken
/// source  Mesa Imaging, SR4000 user manual (axes, amplitude, confidence); the text format is that of the data in
///         github.com/rising-turtle/slam_matlab
class Sr4000 final : public FrameSource {
 public:
  Sr4000() {
    params_.add("path", settings_.path)
        .required()
        .doc("The folder. A leading ${PPM_DATA} is replaced by that environment variable, or by ../shared/data.");
    params_.add("focal", settings_.focal_px)
        .unit("px")
        .above(0)
        .doc("Focal length of the images that are given, after the lens' distortion is taken out.");
    params_.add("rate", settings_.rate_hz)
        .unit("Hz")
        .above(0)
        .doc("Images per second: an image's time is its place in the folder divided by this.");
  }

 private:
  std::unique_ptr<const FrameSequence> open_sequence() const override {
    return std::make_unique<Sr4000Sequence>(settings_);
  }

  Sr4000Settings settings_;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::Sr4000>("source.sr4000", "Reads images of a SwissRanger SR4000 time-of-flight camera, stored as text.",
                     "Mesa Imaging, SR4000 user manual; text format of rising-turtle/slam_matlab");
}
