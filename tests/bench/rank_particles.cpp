// How well weightings tell good poses from bad ones: particles are drawn around the reference pose of every tenth frame
// of a 7-Scenes folder, all with the same map, which was made from the frames before with the reference poses. Prints a
// table: one line a weighting.
//   rank_particles FOLDER [FRAMES [PARTICLES]]
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/core.h>
#include <numeric>

#include "framework/core/timing.hpp"
#include "framework/graph/harness.hpp"
#include "framework/roles/frame_conditioning.hpp"
#include "modules/sources/seven_scenes_sequence.hpp"
#include "tests/map_update/mapper.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;

namespace {

constexpr double kSigmaT = 0.006, kSigmaR = 0.4 * EIGEN_PI / 180;  // m, rad, of the particles
constexpr int kStride = 4;                                         // of the views that are weighed

/// Distance of a pose from the reference, in standard deviations of the particles.
double error_of(const Pose& reference, const Pose& pose) {
  const Pose off = reference.inverse() * pose;
  return std::hypot(off.translation().norm() / kSigmaT, rotation_angle(off) / kSigmaR);
}

/// Position of each value in ascending order.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<double> rank(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<double>(i);
  return rank;
}

/// Spearman's rank correlation.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto ra = ranks(a), rb = ranks(b);
  const auto n = static_cast<double>(a.size());
  double squares = 0;
  for (std::size_t i = 0; i < ra.size(); ++i) squares += (ra[i] - rb[i]) * (ra[i] - rb[i]);
  return 1 - 6 * squares / (n * (n * n - 1));
}

/// One weighting, and what it made of each frame.
struct Candidate {
  Candidate(const std::string& module_, const std::string& params_)
      : module(module_), params(params_), harness(test::builtin(), module_, params_) {}

  void weigh(const std::shared_ptr<const Frame>& frame, const std::vector<Pose>& poses,
             const std::vector<PredictionHandle>& views, const Pose& reference) {
    auto& belief = harness.belief();
    belief.init(poses.size(), reference, nullptr);
    belief.pose = poses;
    belief.prediction = views;
    harness.input<Frame>("frame", frame);
    harness.tick();
    std::vector<double> error, log_weight = belief.log_weight;
    for (const auto& pose : poses) error.push_back(error_of(reference, pose));
    const auto nearest = static_cast<std::size_t>(std::min_element(error.begin(), error.end()) - error.begin());
    double mean_error = 0, entropy = 0;
    for (std::size_t i = 0; i < error.size(); ++i) {
      const double w = std::exp(log_weight[i]);
      mean_error += w * error[i];
      if (w > 0) entropy -= w * log_weight[i];
    }
    rank.push_back(static_cast<double>(error.size()) - ranks(log_weight)[nearest]);
    best_error.push_back(error[belief.best()]);
    weighted_error.push_back(mean_error);
    spearman.push_back(-correlation(log_weight, error));
    ess.push_back(belief.ess());
    entropies.push_back(entropy);
  }

  std::string module, params;
  Harness harness;
  std::vector<double> rank, best_error, weighted_error, spearman, ess, entropies;
};

void print(const std::vector<std::unique_ptr<Candidate>>& candidates, std::size_t particles, std::size_t frames) {
  fmt::print("{} particles, {} frames\n\n", particles, frames);
  fmt::print(
      "| weighting | rank of the nearest, median | error of the best, sigma | weighted error, sigma | rank correlation "
      "| ESS, median | entropy, nats |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (const auto& c : candidates)
    fmt::print("| `{}` {} | {:.0f} | {:.2f} | {:.2f} | {:.3f} | {:.1f} | {:.2f} |\n", c->module, c->params,
               quantile(c->rank, 0.5), mean(c->best_error), mean(c->weighted_error), mean(c->spearman),
               quantile(c->ess, 0.5), mean(c->entropies));
}

std::vector<std::unique_ptr<Candidate>> candidates() {
  std::vector<std::unique_ptr<Candidate>> all;
  auto add = [&](const char* module, const char* params) {
    all.push_back(std::make_unique<Candidate>(module, params));
  };
  add("weighting.gaussian", "{}");
  add("weighting.gaussian_color", "{}");
  add("weighting.gaussian_color", "{exposure: gain}");
  add("weighting.robust", "{}");
  add("weighting.robust_color", "{exposure: fixed}");
  add("weighting.robust_color", "{}");
  add("weighting.robust_color", "{color_temper: 0.01}");
  add("weighting.robust_color", "{color_temper: 0.1}");
  add("weighting.robust_color", "{color_temper: 0.3}");
  add("weighting.robust_color", "{model_color: 0.06}");
  add("weighting.robust_color", "{temper: 1e-9, color_temper: 0.1}");
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "rank_particles FOLDER [FRAMES [PARTICLES]]\n");
    return 2;
  }
  const std::int64_t frames = argc > 2 ? std::atoll(argv[2]) : 300;
  const auto particles = static_cast<std::size_t>(argc > 3 ? std::atoll(argv[3]) : 200);
  SevenScenesSettings settings;
  settings.path = argv[1];
  settings.color = true;
  settings.color_camera = {262.5, {-0.025, 0, 0}};
  const SevenScenesSequence sequence(settings);
  const FrameConditioning conditioning;
  PpmSettings map;
  map.color_channels = 3;
  test::Mapper mapper({}, map);
  const auto all = candidates();
  for (std::int64_t index = 0; index < std::min(frames, sequence.size()); ++index) {
    const auto frame = std::make_shared<const Frame>(conditioning.apply(sequence.read(index), 2));
    if (index % 10 != 5) {
      mapper.add(*frame);
      continue;
    }
    if (index < 20) continue;
    Rng rng(1, static_cast<std::uint32_t>(index), 0, purpose_key("rank_particles"));
    std::vector<Pose> poses;
    std::vector<PredictionHandle> views;
    for (std::size_t i = 0; i < particles; ++i) {
      Twist xi;
      for (int k = 0; k < 6; ++k) xi[k] = (k < 3 ? kSigmaT : kSigmaR) * rng.normal();
      poses.push_back(*frame->T_world_camera_ref * se3_exp(xi));
      views.push_back(std::make_shared<const Prediction>(mapper.predict(frame->camera, poses.back(), kStride)));
    }
    for (const auto& c : all) c->weigh(frame, poses, views, *frame->T_world_camera_ref);
  }
  print(all, particles, all.front()->rank.size());
}
