#include "framework/graph/registry.hpp"
#include "framework/roles/frame_source.hpp"
#include "modules/sources/seven_scenes_sequence.hpp"

namespace ppm {
namespace {

/// A folder of the 7-Scenes data set, or in its layout.
/// frame   depth in m from frame-*.depth.png (0 and 65535: no return), stamp number / rate, color if asked for,
///         reference pose from frame-*.pose.txt (camera to world, made orthonormal)
/// throws  DataError naming file and frame: no such folder, no images, no or broken intrinsics, pose or image
/// source  Shotton et al., "Scene coordinate regression forests for camera relocalization in RGB-D images", CVPR 2013
class SevenScenes final : public FrameSource {
 public:
  SevenScenes() {
    params_.add("path", settings_.path)
        .required()
        .doc("The folder. A leading ${PPM_DATA} is replaced by that environment variable, or by ../shared/data.");
    params_.add("depth_scale", settings_.depth_scale).above(0).doc("Depth units of the image per metre.");
    params_.add("rate", settings_.rate_hz)
        .unit("Hz")
        .above(0)
        .doc("Images per second: an image's time is its number divided by this.");
    params_.add("color", settings_.color)
        .doc("Also read the colour images.");
    params_.add("color_focal", settings_.color_camera.focal_px)
        .unit("px")
        .range(0, 1e5)
        .doc(
            "Focal length of the camera that took the colour images, to register them to depth pixel by pixel; its "
            "image has the size and the principal point of the depth image. 0 takes them as they are. The data set's "
            "own, of a Kinect, are not registered: 0.897 times the depth camera's focal length.");
    params_.add("color_offset", settings_.color_camera.t_color_depth)
        .unit("m")
        .doc(
            "The depth camera's centre in the colour camera's frame, whose axes are parallel; a Kinect's is [-2.5 cm, "
            "0 cm, 0 cm]. Only with color_focal.");
  }

 private:
  std::unique_ptr<const FrameSequence> open_sequence() const override {
    return std::make_unique<SevenScenesSequence>(settings_);
  }

  SevenScenesSettings settings_;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::SevenScenes>("source.seven_scenes", "Reads depth images and poses in the layout of the 7-Scenes data set.",
                          "Shotton et al., CVPR 2013");
}
