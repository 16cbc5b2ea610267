#include "modules/recovery/loss_watch.hpp"

#include <algorithm>

namespace ppm {

void LossWatch::declare(Params& params) {
  params.add("lost_outliers", lost_outliers_)
      .range(0, 1)
      .doc("A view does not explain a frame where more than this share of the pixels that its map shows are outliers.");
  params.add("lost_inliers", lost_inliers_)
      .range(0, 1)
      .doc("Nor where it explains less than this share of the compared pixels.");
  params.add("found_outliers", found_outliers_)
      .range(0, 1)
      .doc("A view explains a frame where no more than this share of the pixels that its map shows are outliers.");
  params.add("found_inliers", found_inliers_).range(0, 1).doc("And at least this share of the compared pixels must be explained.");
  params.add("patience", patience_)
      .range(1, 1000)
      .doc("The camera is lost when no particle explains so many frames in a row. No map learns from them.");
  params.add("doubt", doubt_frames_)
      .range(0, 100000)
      .doc(
          "While the camera is tracked but not explained well, known places are tried after each so many such frames in a row: "
          "another place that explains the frame is then taken. 0: never.");
  params.add("confirm", confirm_)
      .range(1, 1000)
      .doc("It is found when so many frames are explained from a place that explained one.");
}

LossWatch::Verdict LossWatch::judge(const ViewFit& fit) const {
  const double outliers = fit.outliers, inliers = (1.0 - fit.outliers) * (1.0 - fit.misses);
  if (outliers > lost_outliers_ || inliers < lost_inliers_) return Verdict::unexplained;
  return outliers <= found_outliers_ && inliers >= found_inliers_ ? Verdict::explained : Verdict::doubtful;
}

LossWatch::Phase LossWatch::next(std::span<const ViewFit> fits) {
  verdict_ = Verdict::unexplained;
  for (const auto& fit : fits) verdict_ = std::min(verdict_, judge(fit));
  switch (phase_) {
    case Phase::tracked:
      doubt_ = verdict_ == Verdict::explained ? 0 : doubt_ + 1;
      if (verdict_ == Verdict::explained) count_ = 0;
      if (verdict_ == Verdict::unexplained && ++count_ >= patience_) lose();
      break;
    case Phase::lost:
      if (verdict_ == Verdict::explained) returned();
      break;
    case Phase::returning:
      if (verdict_ == Verdict::unexplained)
        lose();
      else if (verdict_ == Verdict::explained && ++count_ >= confirm_)
        set(Phase::tracked);
      break;
  }
  return phase_;
}

void LossWatch::save(RecordWriter& out) const {
  out.add(phase_);
  out.add(verdict_);
  out.add(count_);
  out.add(doubt_);
}

void LossWatch::load(RecordReader& in) {
  in.take(phase_);
  in.take(verdict_);
  in.take(count_);
  in.take(doubt_);
}

}  // namespace ppm
