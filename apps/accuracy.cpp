#include "apps/accuracy.hpp"

#include <algorithm>

#include "framework/roles/frame_source.hpp"
#include "framework/roles/online_path.hpp"
#include "framework/roles/seen_surface.hpp"
#include "framework/roles/sensor_models.hpp"
#include "framework/roles/view_predictor.hpp"

namespace ppm {

namespace {

std::string holdout_lines(const Holdout& h) {
  const auto& s = h.score;
  std::string text = fmt::format(
      "  held out    coverage {:.4f}   median {:.2f} mm   truncated mean {:.2f} mm   within 1/2/5 cm {:.3f} {:.3f} {:.3f}   "
      "({} frames, poses: {})\n",
      s.coverage, s.median_mm, s.mean_trunc20cm_mm, s.within_1cm, s.within_2cm, s.within_5cm, h.frames, h.poses);
  if (const auto& c = h.color)
    text += fmt::format("               colour: median {:.3f}   RMS {:.3f} ({:.3f} with changes of exposure)\n", c->median,
                        c->rms, c->rms_as_is);
  return text;
}

/// T_map_world: see map_from_reference().
std::optional<SurfaceScore> measure_surface(const Map& map, const Pose& T_map_world, const FrameSource& source,
                                            std::int64_t last, const Workers& workers) {
  const auto truth = source.true_surface();
  if (!truth) return std::nullopt;
  const auto seen = seen_surface(*truth, source, last, workers);
  if (seen.empty()) return std::nullopt;
  return score_surface(map.mesh(Surface::displaced), T_map_world.inverse(), *truth, seen, workers);
}

std::string surface_line(const SurfaceScore& s) {
  return fmt::format(
      "  surface     accuracy {:.2f} mm   completeness {:.2f} mm (medians)   within 2 cm: precision {:.4f}   recall {:.4f}   "
      "F {:.4f}\n",
      s.accuracy.median_mm, s.completeness.median_mm, s.precision(), s.recall(), s.f_score());
}

}  // namespace

ViewPredictor* predictor_for(const Graph& graph, const Map& map) {
  auto* predictor = graph.first<ViewPredictor>();
  if (!predictor) return nullptr;
  const auto& needs = predictor->belief.facets().needs;
  return std::ranges::find(needs, fmt::format("map.{}", map.kind())) != needs.end() ? predictor : nullptr;
}

Accuracy measure_accuracy(const Graph& graph, const std::vector<StampedPose>& path, std::int64_t last_index,
                          const Map* map, HoldoutFrom from, const Workers& workers) {
  Accuracy result;
  const auto* source = graph.first<FrameSource>();
  if (!source) return result;
  const auto reference = source->reference(last_index);
  if (path.size() >= 2 && reference.size() >= 2) result.trajectory = trajectory_error(path, reference);

  if (map && !reference.empty())
    result.surface = measure_surface(*map, map_from_reference(path, reference), *source, last_index, workers);

  auto* predictor = map ? predictor_for(graph, *map) : nullptr;
  if (source->held_out().empty() || !predictor) return result;
  if (from == HoldoutFrom::reference && reference.empty())
    throw ConfigError({}, "the source has no reference poses to predict held-out frames from; use --poses estimated");
  auto score = [&](const HoldoutPoses& poses) {
    return score_holdout(*map, *source, sensor_models(graph), last_index, *predictor, poses, workers);
  };
  bool path_is_reference = false;
  if (from != HoldoutFrom::estimated && !reference.empty()) {
    const auto poses = reference_poses(path, reference);
    path_is_reference = poses.name == kReferencePoses;
    result.holdout = score(poses);
  }
  if (from == HoldoutFrom::estimated || (from == HoldoutFrom::both && !path_is_reference))
    result.holdout_estimated = score(estimated_poses(path, source->follows_held_out()));
  return result;
}

void measure_path(const Graph& graph, const std::vector<StampedPose>& path, const Workers& workers, Accuracy& accuracy) {
  const auto* source = graph.first<FrameSource>();
  if (!source || path.empty()) return;
  if (const auto* online = graph.first<OnlinePath>(); online && online->online_path().size() >= 2) {
    const auto reference = source->reference(path.back().frame);
    accuracy.online_estimate = online->online_estimate();
    if (reference.size() >= 2) accuracy.trajectory_online = trajectory_error(online->online_path(), reference);
  }
  accuracy.revisits = score_revisits(path, *source, {}, workers);
}

std::string revisits_line(const ReprojectionError& error, const RevisitSettings& settings) {
  const auto* gap = settings.form == RevisitSettings::Gap::exactly ? "" : " and more";
  return fmt::format("  revisits    median {:.2f} mm   mean {:.2f} mm   beyond 10 cm {:.3f}   ({} pairs of images, {}{} apart)\n",
                     error.median_mm, error.mean_mm, error.beyond_10cm, error.pairs, settings.gap, gap);
}

std::string accuracy_table(const Accuracy& accuracy) {
  std::string text;
  if (const auto& t = accuracy.trajectory) {
    text += fmt::format("  trajectory  ATE {:.4f} m   RPE {:.4f} m, {:.3f} deg   ({} poses)\n", t->ate_m.rmse,
                        t->rpe_trans_m.rmse, t->rpe_rot_deg.rmse, t->pairs);
  }
  for (const auto* h : {&accuracy.holdout, &accuracy.holdout_estimated})
    if (*h) text += holdout_lines(**h);
  if (accuracy.surface) text += surface_line(*accuracy.surface);
  if (accuracy.revisits) text += revisits_line(*accuracy.revisits, {});
  return text;
}

}  // namespace ppm
