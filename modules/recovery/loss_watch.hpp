#pragma once
#include <cstdint>
#include <span>

#include "framework/config/params.hpp"
#include "framework/core/record.hpp"
#include "framework/slam/view_fit.hpp"

namespace ppm {

/// Whether particles are where the camera is, by how far their views explain the frames. With hysteresis: what is lost
/// must be explained better than what was tracked, and for a while.
class LossWatch {
 public:
  enum class Phase : std::uint8_t {
    tracked,    ///< a particle explains the frames, or did a few frames ago
    lost,       ///< none did for `patience` frames
    returning,  ///< a particle stands where a frame was explained, and has to hold the place for `confirm` more
  };
  enum class Verdict { explained, doubtful, unexplained };

  void declare(Params& params);
  /// Of one view.
  Verdict judge(const ViewFit& fit) const;
  /// Takes the next frame's fits, of all particles; returns the phase that they lead to.
  Phase next(std::span<const ViewFit> fits);
  /// The place is not known, whatever the fits say.
  void lose() { set(Phase::lost); }
  /// A particle was put where the frame is explained.
  void returned() { set(Phase::returning); }

  Phase phase() const { return phase_; }
  /// Of the last frame: no particle explained it.
  Verdict verdict() const { return verdict_; }
  /// Tracked, and better looked for elsewhere: for so many frames in a row none was explained well.
  bool doubted() const { return doubt_frames_ > 0 && doubt_ > 0 && doubt_ % doubt_frames_ == 0; }
  /// Frames in a row that were tracked and not explained well.
  int doubt() const { return doubt_; }
  /// Tracked, and nothing speaks loudly against it.
  bool sure() const { return phase_ == Phase::tracked && count_ == 0; }

  void save(RecordWriter& out) const;
  void load(RecordReader& in);

 private:
  void set(Phase phase) {
    phase_ = phase;
    count_ = doubt_ = 0;
  }

  double lost_outliers_ = 0.35, found_outliers_ = 0.15, lost_inliers_ = 0.15, found_inliers_ = 0.4;
  int patience_ = 3, confirm_ = 3, doubt_frames_ = 5;
  Phase phase_ = Phase::tracked;
  Verdict verdict_ = Verdict::explained;
  int count_ = 0;  // tracked: unexplained frames in a row; returning: explained ones
  int doubt_ = 0;
};

}  // namespace ppm
