#pragma once
#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "framework/graph/module.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/frame_sequence.hpp"
#include "framework/slam/trajectory.hpp"

namespace ppm {

/// A sequence of images: the base of every `source.*`. A source opens a FrameSequence; selection, holding out, decimation,
/// range limits, noise model and prefetch of the next frame are done here, the same for all.
class FrameSource : public Module {
 public:
  Out<Frame> frame{this, "frame", "The next image that is not held out."};

  void open(Context& context) override;
  void tick(Context& context) override;

  /// Indices of the images in [first, last] that were held out, ascending. Valid after open().
  const std::vector<std::int64_t>& held_out() const { return held_out_; }
  /// Indices of the images to be mapped, ascending. Valid after open().
  const std::vector<std::int64_t>& selected() const { return selected_; }
  /// A held-out image at the source's own resolution (no pixel stride), with range limits and sigma. Throws DataError.
  Frame full_frame(std::int64_t index);
  /// The reference path over the selected images that have a pose; empty where the source has none. Valid after open().
  std::vector<StampedPose> reference();
  /// Opens the sequence without a run, for evaluation.
  void open_for_evaluation();

 protected:
  FrameSource();
  /// The sequence that the parameters name. Called once. Throws DataError where the folder is unusable.
  virtual std::unique_ptr<const FrameSequence> open_sequence() const = 0;

 private:
  Frame load(std::int64_t index, int stride);

  std::int64_t first_ = 0, last_ = -1, stride_ = 1;
  int pixel_stride_ = 1;
  double min_range_m_ = 0.3, max_range_m_ = 10.0;
  double sigma_floor_ = 0.0012, sigma_quadratic_ = 0.0019, sigma_near_ = 0.4;
  std::string holdout_ = "none";
  std::int64_t holdout_every_ = 0;

  std::vector<std::int64_t> selected_, held_out_;
  std::size_t next_ = 0;
  std::unique_ptr<const FrameSequence> sequence_;
  std::future<Frame> prefetched_;  // below sequence_, which it reads: it is waited for first
};

}  // namespace ppm
