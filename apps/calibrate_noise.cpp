#include "apps/calibrate_noise.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>

#include "apps/graph_options.hpp"
#include "apps/run_report.hpp"
#include "framework/roles/holdout.hpp"
#include "framework/roles/sensor_models.hpp"
#include "framework/slam/depth_noise_fit.hpp"
#include "framework/slam/tum_trajectory.hpp"
#include "modules/maps/ppm/ppm_file.hpp"

namespace ppm {
namespace {

struct NoiseOptions {
  std::filesystem::path run;
  std::vector<std::filesystem::path> plugins;
  int threads = 0;
};

/// The residuals of a held-out frame where the map shows something.
std::vector<DepthResidual> residuals_of(const Frame& frame, const Prediction& view) {
  std::vector<DepthResidual> out;
  for (int y = 0, k = 0; y < view.camera.rows; ++y)
    for (int x = 0; x < view.camera.cols; ++x, ++k) {
      const auto i = static_cast<std::size_t>(k);
      const int pixel = (kHoldoutStep / 2 + kHoldoutStep * y) * frame.camera.cols + kHoldoutStep / 2 + kHoldoutStep * x;
      if (!frame.valid(pixel) || !view.hit(i)) continue;
      const double length = view.camera.ray(x, y).norm(), z = frame.depth[static_cast<std::size_t>(pixel)];
      const auto direction = view.direction(i);
      const double cosine = view.cosine(i, direction);
      const double tangent = std::sqrt(std::max(0.0, 1 - cosine * cosine)) / cosine;
      out.push_back({z, z - view.expected_range(i, direction) / length, view.range_variance(i, direction) / (length * length),
                     frame.sigma[static_cast<std::size_t>(pixel)], z / std::abs(frame.camera.fx) * tangent});
    }
  return out;
}

/// The residuals of all held-out frames that have a pose, frame by frame.
std::vector<std::vector<DepthResidual>> look(const Graph& graph, const NoiseOptions& o) {
  auto* source = graph.first<FrameSource>();
  auto* predictor = graph.first<ViewPredictor>();
  if (!source || !predictor) throw ConfigError({}, "the run's graph has no source, or no node that predicts views");
  const auto map = load_ppm(o.run / "map.ppm");
  source->open_for_evaluation();
  const auto path = read_tum(o.run / "trajectory.tum");
  const auto last = last_index_of_run(o.run);
  const auto reference = source->reference(last);
  HoldoutPoses poses = estimated_poses(path, source->follows_held_out());
  if (!reference.empty() && reference_poses(path, reference).name == kReferencePoses) poses = reference_poses(path, reference);
  const Workers workers(o.threads);
  predictor->prepare({map.get()}, workers);
  const auto sensor = sensor_models(graph);
  const auto& indices = source->held_out();
  std::vector<std::vector<DepthResidual>> out(indices.size());
  workers.for_each(indices.size(), [&](std::size_t k, int worker) {
    if (indices[k] > last) return;
    Frame frame = source->full_frame(indices[k]);
    for (const auto* model : sensor) model->set_noise(frame);
    const auto pose = poses.T_map_camera(frame);
    if (!pose) return;
    Prediction view;
    view.reset(DepthScorer::sampling_camera(frame.camera, kHoldoutStep), 1, *pose, map->color_channels());
    predictor->predict_all(*map, view, worker);
    out[k] = residuals_of(frame, view);
  });
  return out;
}

void print_quality(const std::string& name, const NoiseQuality& q) {
  fmt::print("#   {:<40} {:7.3f}  {:.3f} {:.3f}\n", name, q.log_density, q.within_1_sigma, q.within_2_sigma);
}

void calibrate_noise(const NoiseOptions& o) {
  GraphOptions options;
  options.file = o.run / "config.effective.yaml";
  options.plugins = o.plugins;
  const Graph graph = options.load();
  std::vector<DepthResidual> all, half[2];
  std::size_t frames = 0;
  for (const auto& of_frame : look(graph, o)) {
    if (of_frame.empty()) continue;
    all.insert(all.end(), of_frame.begin(), of_frame.end());
    auto& part = half[frames++ % 2];
    part.insert(part.end(), of_frame.begin(), of_frame.end());
  }
  const auto fit = fit_depth_noise(all);
  const DepthNoise& n = fit.noise;
  fmt::print("sigma_floor: {:.4g} m\nsigma_quadratic: {:.4g}\nsigma_near: {:.3g} m\nsigma_lateral: {:.3g} px\n", n.floor, n.quadratic,
             n.near, n.lateral_px);
  fmt::print("# {} held-out frames, {} pixels, outliers {:.3f}\n", frames, all.size(), fit.outliers);
  fmt::print("# mean log density (1/m), shares within 1 and 2 sigma (Gaussian noise: 0.683 0.954)\n");
  print_quality("the run's noise model", noise_quality(all));
  print_quality("this fit", noise_quality(all, &n));
  for (int k = 0; k < 2; ++k) {
    const auto other = fit_depth_noise(half[1 - k]);
    print_quality(k ? "frames of odd order, fit to the others" : "frames of even order, fit to the others",
                  noise_quality(half[k], &other.noise));
  }
}

}  // namespace

void add_calibrate_noise(CLI::App& calibrate) {
  auto* command = calibrate.add_subcommand(
      "noise", "Noise of depth and across the line of sight: parameters of a source, from a run's held-out frames and its map");
  auto o = std::make_shared<NoiseOptions>();
  command
      ->add_option("run", o->run, "Folder of a run, with map.ppm (sink.map_ppm) and trajectory.tum (sink.trajectory_tum)")
      ->required()
      ->type_name("FOLDER");
  command->add_option("--threads", o->threads, "Worker threads; 0 is as many as the machine has")
      ->check(CLI::Range(0, 4096));
  add_plugin_option(*command, o->plugins);
  command->callback([o] { calibrate_noise(*o); });
}

}  // namespace ppm
