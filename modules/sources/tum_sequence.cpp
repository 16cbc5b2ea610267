#include "modules/sources/tum_sequence.hpp"

#include <algorithm>

#include "framework/core/error.hpp"
#include "framework/slam/tum_trajectory.hpp"
#include "modules/sources/data_path.hpp"
#include "modules/sources/depth_image.hpp"
#include "modules/sources/pose_lookup.hpp"

namespace ppm {

TumSequence::TumSequence(const TumSettings& settings) : settings_(settings), folder_(data_folder(settings.path)) {
  images_ = list_tum_images(folder_, settings_.max_dt_s, remarks_);
  camera_ = {0, 0, settings_.fx, settings_.fy, settings_.cx, settings_.cy};
  set_image_size(images_.front().depth, 0, camera_);

  const auto truth = folder_ / "groundtruth.txt";
  if (!std::filesystem::exists(truth)) {
    remarks_.push_back("there is no groundtruth.txt: the images have no reference pose");
    return;
  }
  path_ = read_tum(truth);
  const auto without = std::count_if(images_.begin(), images_.end(), [&](const TumImage& image) {
    return !pose_at(path_, image.stamp_s, settings_.max_dt_s);
  });
  if (without > 0) remarks_.push_back(fmt::format("{} of {} images have no reference pose", without, images_.size()));
}

std::optional<Pose> TumSequence::reference_pose(std::int64_t index) const {
  return pose_at(path_, stamp_s(index), settings_.max_dt_s);
}

Frame TumSequence::read(std::int64_t index) const {
  Frame frame;
  frame.index = index;
  frame.stamp_s = stamp_s(index);
  frame.camera = camera_;
  frame.T_world_camera_ref = reference_pose(index);
  read_depth_image(image(index).depth, settings_.depth_scale, frame);
  if (!settings_.color) return frame;
  if (image(index).color.empty())
    throw DataError(image(index).depth.string(), index,
                    fmt::format("no colour image within {} s of it", settings_.max_dt_s));
  read_color_image(image(index).color, frame);
  return frame;
}

}  // namespace ppm
