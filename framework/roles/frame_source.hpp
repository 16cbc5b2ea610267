#pragma once
#include <cstdint>
#include <future>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/graph/module.hpp"
#include "framework/roles/frame_conditioning.hpp"
#include "framework/roles/frame_selection.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/frame_sequence.hpp"
#include "framework/slam/trajectory.hpp"

namespace ppm {

/// A sequence of images: the base of every `source.*`. A source opens a FrameSequence; selection, holding out,
/// correction of the camera, decimation, range limits, noise model and prefetch of the next frame are done here, the same for all. What goes
/// wrong with an image is thrown by the tick whose image it is.
class FrameSource : public Module {
 public:
  Out<Frame> frame{this, "frame", "The next image; each is later than the one before. Held-out ones come where they are to be followed."};

  void open(Context& context) override;
  void tick(Context& context) override;
  void save(RecordWriter& out) const override;
  /// Throws DataError where the sequence has not the images that it had.
  void load(RecordReader& in) override;

  /// Indices of the images in [first, last] that were held out, ascending. Valid after open().
  const std::vector<std::int64_t>& held_out() const { return selection_.held_out; }
  /// Indices of the images to be mapped, ascending. Valid after open().
  const std::vector<std::int64_t>& selected() const { return selection_.mapped; }
  /// Indices of the images that the graph gets, ascending, and the stamp of one. Valid after open().
  const std::vector<std::int64_t>& given() const { return given_; }
  double stamp_s(std::int64_t index) const;
  /// Whether held-out images are given too, to be followed and not mapped.
  bool follows_held_out() const { return held_out_ == HeldOut::followed; }
  /// An image at the source's own resolution (no pixel stride), with range limits and sigma. Throws DataError.
  Frame full_frame(std::int64_t index) const;
  /// The same with another correction of the camera than the parameters'.
  Frame full_frame(std::int64_t index, const CameraCorrection& correction) const;
  const CameraCorrection& camera_correction() const { return conditioning_.correction; }
  /// What the images show, where it is known exactly: see FrameSequence::true_surface(). Valid after open().
  std::unique_ptr<const TrueSurface> true_surface() const;
  /// The reference path over the images that are given, up to the image `last`, that have a pose; empty where the source has none.
  /// Valid after open(). Throws DataError where a pose is broken.
  std::vector<StampedPose> reference(std::int64_t last = std::numeric_limits<std::int64_t>::max()) const;
  /// Opens the sequence without a run, for evaluation.
  void open_for_evaluation();

 protected:
  FrameSource();
  /// The sequence that the parameters name. Called once. Throws DataError where the folder is unusable.
  virtual std::unique_ptr<const FrameSequence> open_sequence() const = 0;

 private:
  enum class HeldOut { left_out, followed };
  void declare_selection();
  void declare_noise();
  void declare_correction();
  std::optional<Pose> checked_pose(std::int64_t index) const;
  double stamp_before(std::int64_t index) const;
  Frame load(std::int64_t index, int stride, const FrameConditioning& conditioning) const;
  void prefetch();

  std::int64_t first_ = 0, last_ = -1, stride_ = 1;
  int pixel_stride_ = 1;
  std::string holdout_ = "none";
  HeldOut held_out_ = HeldOut::left_out;
  FrameConditioning conditioning_;

  FrameSelection selection_;
  std::vector<std::int64_t> given_;  // indices of the images that the graph gets, ascending
  std::size_t next_ = 0;             // of given_
  double last_stamp_s_ = 0;
  std::unique_ptr<const FrameSequence> sequence_;
  std::future<Frame> prefetched_;  // below what load() reads: it is waited for first
};

}  // namespace ppm
