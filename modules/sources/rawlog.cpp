#include "framework/graph/registry.hpp"
#include "framework/roles/frame_source.hpp"
#include "modules/sources/rawlog_sequence.hpp"

namespace ppm {
namespace {

/// The range images (CObservation3DRangeScan) of a rawlog of MRPT, plain or compressed, in either of its formats:
/// observations alone, or actions and sensory frames.
/// frame   depth along the axis, whatever the camera stores; T_base_camera from the sensor's pose; confidence; colour if
///         asked for and registered to depth; imu (CObservationIMU, turned to the body's axes); T_odom_base
///         (CObservationOdometry or a CObservationRobotPose, interpolated to the image, or the sum of the actions);
///         reference poses (CObservationRobotPose)
/// throws  DataError: a file that is cut short or damaged (entry and byte), holds no range image, or something that is
///         no observation
/// source  MRPT
class RawlogSource final : public FrameSource {
 public:
  RawlogSource() {
    params_.add("path", settings_.path)
        .required()
        .doc("The file. A leading ${PPM_DATA} is replaced by that environment variable, or by ../shared/data.");
    params_.add("camera", settings_.camera)
        .doc("Label of the camera whose images are read; may be left out where the file has one camera.");
    params_.add("color", settings_.color).doc("Also read the colour images, which must be registered to depth.");
    params_.add("odometry", settings_.odometry)
        .doc(
            "Label of the poses (CObservationRobotPose) that are odometry; where there are none, CObservationOdometry "
            "is, or the actions.");
    params_.add("reference", settings_.reference)
        .doc("Label of the poses (CObservationRobotPose) that are the reference.");
    params_.add("max_dt", settings_.max_dt_s)
        .unit("s")
        .range(0, 10)
        .doc("Largest difference in time between an image and an odometry or reference pose that goes with it.");
  }

 private:
  std::unique_ptr<const FrameSequence> open_sequence() const override {
    return std::make_unique<RawlogSequence>(settings_);
  }

  RawlogSettings settings_;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::RawlogSource>("source.rawlog",
                           "Reads range images, inertial samples, odometry and poses from a rawlog of MRPT.",
                           "MRPT, mrpt::obs::CRawlog");
}
