#include "framework/graph/registry.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/slam/tum_trajectory.hpp"
#include "modules/sources/data_path.hpp"
#include "modules/sources/depth_image.hpp"
#include "modules/sources/pose_lookup.hpp"
#include "modules/sources/tum_list.hpp"

namespace ppm {
namespace {

struct TumSettings {
  std::filesystem::path path;
  double fx = 525, fy = 525, cx = 319.5, cy = 239.5;  // the ROS default that the benchmark recommends
  double depth_scale = 5000, max_dt_s = 0.02;
  bool color = false;
};

class TumSequence final : public FrameSequence {
 public:
  explicit TumSequence(const TumSettings& settings) : settings_(settings), folder_(data_folder(settings.path)) {
    images_ = list_tum_images(folder_, settings_.max_dt_s, remarks_);
    const auto truth = folder_ / "groundtruth.txt";
    if (std::filesystem::exists(truth)) path_ = read_tum(truth);
    std::size_t without = 0;
    for (const auto& image : images_) without += pose_at(path_, image.stamp_s, settings_.max_dt_s) ? 0 : 1;
    if (without > 0)
      remarks_.push_back(fmt::format("{} of {} images have no reference pose{}", without, images_.size(),
                                     path_.empty() ? " (there is no groundtruth.txt)" : ""));
  }

  std::string name() const override { return folder_.string(); }
  std::int64_t size() const override { return static_cast<std::int64_t>(images_.size()); }
  double stamp_s(std::int64_t index) const override { return image(index).stamp_s; }
  std::optional<Pose> reference_pose(std::int64_t index) const override {
    return pose_at(path_, stamp_s(index), settings_.max_dt_s);
  }
  std::vector<std::string> remarks() const override { return remarks_; }

  Frame read(std::int64_t index) const override {
    Frame frame;
    frame.index = index;
    frame.stamp_s = stamp_s(index);
    frame.camera = {0, 0, settings_.fx, settings_.fy, settings_.cx, settings_.cy};
    frame.T_world_camera_ref = reference_pose(index);
    read_depth_image(image(index).depth, settings_.depth_scale, frame);
    if (settings_.color) {
      if (image(index).color.empty())
        throw DataError(image(index).depth.string(), index,
                        fmt::format("no colour image within {} s of it", settings_.max_dt_s));
      read_color_image(image(index).color, frame);
    }
    return frame;
  }

 private:
  const TumImage& image(std::int64_t index) const { return images_[static_cast<std::size_t>(index)]; }

  TumSettings settings_;
  std::filesystem::path folder_;
  std::vector<TumImage> images_;
  std::vector<StampedPose> path_;
  std::vector<std::string> remarks_;
};

/// A sequence in the layout of the TUM RGB-D benchmark, or of ICL-NUIM in that layout (fy < 0: image rows grow against
/// y). frame   depth in m (0 and 65535: no return), stamp of the depth image, reference pose from groundtruth.txt where
/// there is one
///         near enough in time, color if asked for
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
