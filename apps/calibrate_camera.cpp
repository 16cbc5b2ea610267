#include "apps/calibrate_camera.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <memory>
#include <numbers>
#include <optional>

#include "apps/graph_options.hpp"
#include "framework/core/timing.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/slam/camera_fit.hpp"
#include "framework/slam/tum_trajectory.hpp"

namespace ppm {
namespace {

constexpr std::size_t kLeastFrames = 8;
constexpr double kAssociation_m = 0.2;  // between surfaces that start poses lay onto each other
constexpr double kSameStamp_s = 1e-6;

struct CameraOptions {
  GraphOptions graph;
  std::filesystem::path path;
  int frames = 80, step = 0, threads = 0;
  double overlap = 0.3;
  bool principal_point = false, depth_as_it_is = false;
};

CameraParameters sought(const CameraOptions& o) {
  CameraParameters out;
  out.free = {CameraParameter::focal};
  if (o.principal_point) out.free.insert(out.free.end(), {CameraParameter::cx, CameraParameter::cy});
  if (!o.depth_as_it_is)
    out.free.insert(out.free.end(), {CameraParameter::bend, CameraParameter::bend_x, CameraParameter::bend_y,
                                     CameraParameter::bend_radial});
  return out;
}

/// The pose to start from: the path's at that time, or the reference; nothing where there is none.
std::optional<Pose> start_pose(const Frame& frame, const std::vector<StampedPose>& path) {
  if (path.empty()) return frame.T_world_camera_ref;
  const auto at = std::ranges::lower_bound(path, frame.stamp_s - kSameStamp_s, {}, &StampedPose::stamp_s);
  if (at == path.end() || at->stamp_s > frame.stamp_s + kSameStamp_s) return std::nullopt;
  return at->T_map_camera;
}

/// Frames spread evenly over those that are mapped; those without a pose are left out.
std::vector<CalibrationFrame> read_frames(const FrameSource& source, const CameraOptions& o, const Workers& workers) {
  const auto path = o.path.empty() ? std::vector<StampedPose>() : read_tum(o.path);
  const auto& selected = source.selected();
  const auto count = std::min(selected.size(), static_cast<std::size_t>(o.frames));
  std::vector<std::optional<CalibrationFrame>> read(count);
  workers.for_each(count, [&](std::size_t k, int) {
    const Frame frame = source.full_frame(selected[k * selected.size() / count], {});
    if (const auto pose = start_pose(frame, path))
      read[k] = {surface_patches(frame, o.step > 0 ? o.step : std::max(2, frame.camera.cols / 64)), *pose};
  });
  std::vector<CalibrationFrame> frames;
  for (auto& frame : read)
    if (frame) frames.push_back(std::move(*frame));
  if (frames.size() < kLeastFrames)
    throw DataError("the calibration",
                    fmt::format("{} of {} frames have a pose to start from, and it takes {}; --path gives those of a run",
                                frames.size(), count, kLeastFrames));
  return frames;
}

double median_depth(const std::vector<CalibrationFrame>& frames) {
  std::vector<double> depths;
  for (const auto& f : frames)
    for (const auto& patch : f.patches.all) depths.push_back(1 / patch.disparity);
  return quantile(std::move(depths), 0.5);
}

/// Some of the frames, and a camera fitted to them.
struct Fitted {
  std::vector<FramePair> pairs;
  CameraFit fit;
};

Fitted fit_part(const std::vector<CalibrationFrame>& frames, const CameraCorrection& start,
                const CameraParameters& parameters, double overlap, const Workers& workers) {
  Fitted out;
  out.pairs = overlapping_pairs(frames, start, overlap, kAssociation_m, workers);
  if (out.pairs.size() < frames.size())
    throw DataError("the calibration",
                    fmt::format("{} frames make {} pairs that see {:.0f} % of each other: too little overlap (--frames, --overlap)",
                                frames.size(), out.pairs.size(), 100 * overlap));
  check_observable(out.pairs);
  out.fit = fit_camera(frames, out.pairs, start, parameters, workers);
  return out;
}

double value(const CameraCorrection& c, CameraParameter parameter) {
  switch (parameter) {
    case CameraParameter::focal: return c.focal_scale;
    case CameraParameter::cx: return c.cx_shift;
    case CameraParameter::cy: return c.cy_shift;
    case CameraParameter::bend: return c.depth_bend;
    case CameraParameter::bend_x: return c.depth_bend_x;
    case CameraParameter::bend_y: return c.depth_bend_y;
    case CameraParameter::bend_radial: return c.depth_bend_radial;
  }
  return 0;
}

void print_parameters(const CameraFit& fit, const CameraParameters& parameters) {
  for (Eigen::Index k = 0; k < parameters.size(); ++k) {
    const auto p = parameters.free[static_cast<std::size_t>(k)];
    const bool pixels = p == CameraParameter::cx || p == CameraParameter::cy;
    fmt::print("{:<28} # +- {:.5f}\n",
               fmt::format("{}: {:.5f}{}", to_string(p), value(fit.correction, p), pixels ? " px" : ""), fit.sigma(k));
    if (p == CameraParameter::bend) fmt::print("depth_factor: {:.5f}\n", fit.correction.depth_factor);
  }
}

/// What each half of the frames says alone: they share no image.
void print_halves(const std::vector<CalibrationFrame>& frames, const CameraCorrection& start,
                  const CameraParameters& parameters, const CameraOptions& o, const Workers& workers) {
  const auto middle = frames.begin() + static_cast<std::ptrdiff_t>(frames.size() / 2);
  for (int half = 0; half < 2; ++half) {
    const std::vector<CalibrationFrame> part(half ? middle : frames.begin(), half ? frames.end() : middle);
    fmt::print("# {} half alone:", half ? "second" : "first");
    try {
      const auto fit = fit_part(part, start, parameters, o.overlap, workers).fit;
      for (Eigen::Index k = 0; k < parameters.size(); ++k)
        fmt::print(" {:.4f} +- {:.4f}", value(fit.correction, parameters.free[static_cast<std::size_t>(k)]), fit.sigma(k));
      fmt::print("\n");
    } catch (const DataError& e) {
      fmt::print(" {}\n", e.what());
    }
  }
}

double path_ratio(const std::vector<CalibrationFrame>& frames, const std::vector<FramePair>& pairs, const CameraFit& fit) {
  double given = 0, fitted = 0;
  for (const auto& p : pairs) {
    given += (frames[p.first].T_world_camera.translation() - frames[p.second].T_world_camera.translation()).squaredNorm();
    fitted += (fit.T_world_camera[p.first].translation() - fit.T_world_camera[p.second].translation()).squaredNorm();
  }
  return std::sqrt(given / fitted);
}

void calibrate_camera(const CameraOptions& o) {
  const Graph graph = o.graph.load();
  auto* source = graph.first<FrameSource>();
  if (!source) throw ConfigError(Place{o.graph.file.string()}, "the graph has no source of images");
  source->open_for_evaluation();
  const Workers workers(o.threads);
  const auto frames = read_frames(*source, o, workers);
  CameraParameters parameters = sought(o);
  parameters.pivot_m = median_depth(frames);
  const auto start = source->camera_correction();
  const auto [pairs, fit] = fit_part(frames, start, parameters, o.overlap, workers);
  check_found(fit, parameters);
  print_parameters(fit, parameters);
  fmt::print("# {} frames, {} pairs, their axes {:.1f} degrees apart (rms), {} points\n", frames.size(), pairs.size(),
             tilt_rms(pairs) * 180 / std::numbers::pi, fit.points);
  fmt::print("# median from point to plane {:.2f} mm, before {:.2f} mm{}\n", 1e3 * fit.distance_m, 1e3 * fit.distance_before_m,
             fit.converged ? "" : "; the steps had not ended");
  fmt::print("# the given path is {:.4f} times as large as the fitted one; where it is exact, so must depth_factor be\n",
             path_ratio(frames, pairs, fit));
  if (frames.size() >= 2 * kLeastFrames) print_halves(frames, start, parameters, o, workers);
}

}  // namespace

void add_calibrate_camera(CLI::App& calibrate) {
  auto* command = calibrate.add_subcommand(
      "camera", "Focal length and distortion of depth: parameters of a source, from frames that see the same surfaces");
  auto o = std::make_shared<CameraOptions>();
  o->graph.add_to(*command);
  command->add_option("--path", o->path, "Poses to start from, of a run (trajectory.tum), in place of the source's reference")
      ->type_name("FILE");
  command->add_option("--frames", o->frames, "Frames that are compared, evenly spread over the source's")
      ->check(CLI::Range(2, 2000))
      ->capture_default_str();
  command->add_option("--overlap", o->overlap, "Least share of each other that two frames must see to be compared")
      ->check(CLI::Range(0.05, 0.95))
      ->capture_default_str();
  command->add_option("--step", o->step, "Pixels between compared points; 0: a 64th of the image's width")
      ->check(CLI::Range(0, 64));
  command->add_option("--threads", o->threads, "Worker threads; 0 is as many as the machine has")
      ->check(CLI::Range(0, 4096));
  command->add_flag("--principal-point", o->principal_point, "Also find the principal point");
  command->add_flag("--depth-as-it-is", o->depth_as_it_is, "Find no distortion of depth");
  command->callback([o] { calibrate_camera(*o); });
}

}  // namespace ppm
