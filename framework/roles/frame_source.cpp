#include "framework/roles/frame_source.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace ppm {

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Files round their rotations; what is further from orthonormal than this is no rotation.
constexpr double kRotationTolerance = 1e-2;

bool is_rotation(const Eigen::Matrix3d& R) {
  return R.determinant() > 0 &&
         (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kRotationTolerance;
}

}  // namespace

FrameSource::FrameSource() {
  declare_selection();
  declare_noise();
  declare_correction();
}

void FrameSource::declare_selection() {
  params_.add("first", first_).range(0, kNoLimit).doc("Index of the first image used.");
  params_.add("last", last_).range(-1, kNoLimit).doc("Index of the last image used; -1 is the end of the sequence.");
  params_.add("stride", stride_).range(1, kNoLimit).doc("Maps each n-th image, from the first on.");
  params_.add("pixel_stride", pixel_stride_)
      .range(1, 64)
      .doc("Keeps each n-th pixel of each n-th row, from pixel (0, 0) on; held-out images keep all.");
  params_.add("holdout", holdout_)
      .check([this] {
        if (parse_holdout(holdout_) >= 0) return std::string();
        return fmt::format("'{}' is neither 'none' nor of the form 'every 10th' (from 'every 2nd' on)", holdout_);
      })
      .doc(
          "Images kept from the map, to test it on: 'none', or 'every 10th': those with index % 10 == 5 in "
          "first .. last, whatever the stride.");
  params_.add_choice("held_out", held_out_, {{"left_out", HeldOut::left_out}, {"followed", HeldOut::followed}})
      .doc(
          "Whether the graph sees the held-out images: left_out keeps them back; followed gives those behind the first "
          "mapped one in their place in the sequence, for the filter to find their poses, and no map learns from them.");
  params_.add("min_range", conditioning_.min_range_m).unit("m").range(0, kNoLimit).doc("Nearer depths are dropped.");
  params_.add("max_range", conditioning_.max_range_m).unit("m").above(0).doc("Farther depths are dropped.");
}

void FrameSource::declare_noise() {
  params_.add("sigma_floor", conditioning_.sigma_floor)
      .unit("m")
      .above(0)
      .doc(
          "Depth noise of sensors that give none with the image: sigma(z) = sigma_floor + sigma_quadratic * "
          "(z - sigma_near)^2 (Nguyen, Izadi, Lovell, 3DIMPVT 2012).");
  params_.add("sigma_quadratic", conditioning_.sigma_quadratic)
      .range(0, kNoLimit)
      .doc("Growth of the depth noise with the square of the distance, 1/m; see sigma_floor.");
  params_.add("sigma_near", conditioning_.sigma_near)
      .unit("m")
      .range(0, kNoLimit)
      .doc("Distance of least depth noise; see sigma_floor.");
  params_.add("sigma_lateral", conditioning_.sigma_lateral)
      .unit("px")
      .range(0, 10)
      .doc("Noise across the line of sight, in pixels of the image before pixel_stride.");
  params_.add("sigma_color", conditioning_.sigma_color)
      .above(0)
      .doc("Noise of a colour channel, where 0 is black and 1 the brightest that the camera can tell.");
}

void FrameSource::declare_correction() {
  CameraCorrection& c = conditioning_.correction;
  params_.add("focal_scale", c.focal_scale)
      .range(0.1, 10)
      .doc("Corrects the camera: both focal lengths are multiplied by it. `ppm calibrate camera` finds it, and what follows.");
  params_.add("cx_shift", c.cx_shift)
      .unit("px")
      .doc("Corrects the camera: added to the principal point's column, pixels of the image before pixel_stride.");
  params_.add("cy_shift", c.cy_shift).unit("px").doc("The same for its row.");
  params_.add("depth_factor", c.depth_factor)
      .range(0.1, 10)
      .doc(
          "Corrects depths, before all else looks at them: z becomes depth_factor * z / (1 - b z), where b = depth_bend + "
          "depth_bend_x * X + depth_bend_y * Y + depth_bend_radial * (X^2 + Y^2), 1/m, and (X, Y, 1) is the pixel's ray.");
  params_.add("depth_bend", c.depth_bend).range(-1, 1).doc("Corrects depths, 1/m, see depth_factor.");
  params_.add("depth_bend_x", c.depth_bend_x).range(-1, 1).doc("The same, growing to the right.");
  params_.add("depth_bend_y", c.depth_bend_y).range(-1, 1).doc("The same, growing downwards (with fy > 0).");
  params_.add("depth_bend_radial", c.depth_bend_radial).range(-1, 1).doc("The same, growing from the middle outwards.");
}

void FrameSource::open(Context& context) {
  open_for_evaluation();
  for (const auto& remark : sequence_->remarks()) context.log().warning("{}: {}", sequence_->name(), remark);
  context.expect_frames(static_cast<std::int64_t>(given_.size()));
  next_ = 0;
  prefetch();
}

void FrameSource::open_for_evaluation() {
  if (!sequence_) sequence_ = open_sequence();
  selection_ = select_frames(sequence_->name(), sequence_->size(), first_, last_, stride_, parse_holdout(holdout_));
  given_ = follows_held_out() ? selection_.followed() : selection_.mapped;
}

void FrameSource::prefetch() {
  if (next_ == given_.size()) return;
  prefetched_ = std::async(std::launch::async,
                           [this, index = given_[next_]] { return load(index, pixel_stride_, conditioning_); });
}

void FrameSource::tick(Context& context) {
  if (next_ == given_.size()) {
    context.end_of_stream();
    return;
  }
  auto next = std::make_shared<const Frame>(prefetched_.get());
  if (next_ > 0 && !(next->stamp_s > last_stamp_s_))
    throw DataError(
        sequence_->name(), next->index,
        fmt::format("its stamp, {} s, is not later than {} s of the image before", next->stamp_s, last_stamp_s_));
  last_stamp_s_ = next->stamp_s;
  ++next_;
  prefetch();
  frame.set(std::move(next));
}

void FrameSource::save(RecordWriter& out) const {
  out.add(sequence_->size());
  out.add(static_cast<std::uint64_t>(given_.size()));
  out.add(static_cast<std::uint64_t>(next_));
  out.add(last_stamp_s_);
}

void FrameSource::load(RecordReader& in) {
  const auto images = in.take<std::int64_t>();
  const auto selected = in.take<std::uint64_t>();
  if (images != sequence_->size() || selected != given_.size())
    throw DataError(sequence_->name(), fmt::format("has changed: it had {} images, {} of them to be used, and has {} and {}",
                                                   images, selected, sequence_->size(), given_.size()));
  next_ = in.take<std::uint64_t>();
  in.take(last_stamp_s_);
  prefetch();
}

Frame FrameSource::full_frame(std::int64_t index) const {
  return load(index, 1, conditioning_);
}

Frame FrameSource::full_frame(std::int64_t index, const CameraCorrection& correction) const {
  FrameConditioning conditioning = conditioning_;
  conditioning.correction = correction;
  return load(index, 1, conditioning);
}

double FrameSource::stamp_s(std::int64_t index) const {
  PPM_CHECK(sequence_, "the source is not open");
  return sequence_->stamp_s(index);
}

std::unique_ptr<const TrueSurface> FrameSource::true_surface() const {
  PPM_CHECK(sequence_, "the source is not open");
  return sequence_->true_surface();
}

std::vector<StampedPose> FrameSource::reference(std::int64_t last) const {
  PPM_CHECK(sequence_, "the source is not open");
  std::vector<StampedPose> path;
  for (auto index : given_) {
    if (index > last) break;
    if (const auto pose = checked_pose(index)) path.push_back({index, sequence_->stamp_s(index), *pose});
  }
  return path;
}

std::optional<Pose> FrameSource::checked_pose(std::int64_t index) const {
  const auto pose = sequence_->reference_pose(index);
  if (!pose) return std::nullopt;
  if (!is_finite(*pose)) throw DataError(sequence_->name(), index, "the reference pose is not finite");
  if (!is_rotation(pose->linear())) throw DataError(sequence_->name(), index, "the reference pose is no rigid motion");
  return orthonormalized(pose->matrix());
}

/// Of the image before that the graph got; for its first image, of the one before in the sequence.
double FrameSource::stamp_before(std::int64_t index) const {
  const auto given = std::ranges::lower_bound(given_, index);
  if (given != given_.begin()) return sequence_->stamp_s(*std::prev(given));
  return index > 0 ? sequence_->stamp_s(index - 1) : -kNoLimit;
}

Frame FrameSource::load(std::int64_t index, int stride, const FrameConditioning& conditioning) const {
  PPM_CHECK(sequence_, "the source is not open");
  Frame image = sequence_->read(index);
  sequence_->add_motion(stamp_before(index), image);
  PPM_CHECK(image.index == index, "asked for image {}, got {}", index, image.index);
  image.T_world_camera_ref = checked_pose(index);
  image.held_out = std::ranges::binary_search(selection_.held_out, index);
  return conditioning.apply(image, stride);
}

}  // namespace ppm
