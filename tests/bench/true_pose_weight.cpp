// Which weightings keep the true pose in the particle set: in every tenth frame of a 7-Scenes folder particles are drawn
// from the motion prior, as a filter draws them, and the reference pose is added as one more. All have the same map, made
// from the frames before with the reference poses. Prints CSV: a line a weighting and a frame.
//   true_pose_weight FOLDER [FRAMES [PARTICLES]]
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/core.h>

#include "framework/graph/harness.hpp"
#include "framework/roles/frame_conditioning.hpp"
#include "modules/sources/seven_scenes_sequence.hpp"
#include "tests/map_update/mapper.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;

namespace {

constexpr double kSigmaT = 0.003, kSigmaR = 0.2 * EIGEN_PI / 180;  // m, rad an axis: of configs/kitchen_slam.yaml
constexpr int kStride = 2;                                         // of the views: 80x60 = 4800 pixels

/// Distance of a pose from the truth, in standard deviations of the prior.
double error_of(const Pose& truth, const Pose& pose) {
  const Pose off = truth.inverse() * pose;
  return std::hypot(off.translation().norm() / kSigmaT, rotation_angle(off) / kSigmaR);
}

/// From 1: as many weights are larger, and one more.
std::size_t rank_of(std::size_t i, const std::vector<double>& log_weight) {
  return 1 + static_cast<std::size_t>(std::ranges::count_if(log_weight, [&](double l) { return l > log_weight[i]; }));
}

struct Weighed {
  std::string study, module, params;
  Harness harness;
  Weighed(std::string study_, std::string module_, std::string params_)
      : study(std::move(study_)), module(std::move(module_)), params(std::move(params_)),
        harness(test::builtin(), module, params) {}

  /// The last pose is the truth.
  void weigh(const std::shared_ptr<const Frame>& frame, const std::vector<Pose>& poses,
             const std::vector<PredictionHandle>& views) {
    auto& belief = harness.belief();
    belief.init(poses.size(), poses.back(), nullptr);
    belief.pose = poses;
    belief.prediction = views;
    harness.input<Frame>("frame", frame);
    harness.tick();
    const auto truth = poses.size() - 1;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < truth; ++i)
      if (error_of(poses[truth], poses[i]) < error_of(poses[truth], poses[nearest])) nearest = i;
    double error = 0;
    for (std::size_t i = 0; i < truth; ++i) error += std::exp(belief.log_weight[i]) * error_of(poses[truth], poses[i]);
    const double of_truth = std::exp(belief.log_weight[truth]), ess = belief.ess();
    fmt::print("{},\"{}\",\"{}\",{},{},{},{:.6g},{:.6g},{:.6g}\n", study, module, params, frame->index,
               rank_of(nearest, belief.log_weight), rank_of(truth, belief.log_weight),
               std::min(1.0, of_truth * static_cast<double>(poses.size())), error / (1 - std::min(of_truth, 1 - 1e-12)), ess);
  }
};

std::vector<std::unique_ptr<Weighed>> settings() {
  std::vector<std::unique_ptr<Weighed>> all;
  auto add = [&](const char* study, const char* module, const std::string& params) {
    all.push_back(std::make_unique<Weighed>(study, module, params));
  };
  const char *gaussian = "weighting.gaussian", *robust = "weighting.robust";
  add("form", gaussian, "{}");
  add("form", gaussian, "{variance: texel_and_sensor}");
  add("form", gaussian, "{variance: texel_and_sensor, pixels: 300}");
  add("form", gaussian, "{ess_target: 0.3, temper_least: 1e-6}");
  add("form", gaussian, "{variance: texel_and_sensor, ess_target: 0.3, temper_least: 1e-6}");
  add("form", robust, "{}");
  add("form", robust, "{temper: 1, ess_target: 0.3, temper_least: 1e-6}");
  for (const char* share : {"1e-9", "0.05", "0.1", "0.2"})
    for (int pixels : {300, 1200, 4800})
      add("outliers", robust, fmt::format("{{outlier_share: {}, pixels: {}, temper: {:.4g}}}", share, pixels, 36.0 / pixels));
  for (const char* temper : {"1", "0.3", "0.1", "0.03", "0.01", "0.003"})
    add("temper", robust, fmt::format("{{temper: {}}}", temper));
  for (const char* density : {"0.001", "0.01", "0.1", "1", "10"})
    add("misses", robust, fmt::format("{{miss_density: {}}}", density));
  for (const char* sigma : {"0 mm", "2 mm", "5 mm", "1 cm", "2 cm"})
    add("model", robust, fmt::format("{{model_sigma: {}}}", sigma));
  for (const char* jump : {"0 m", "5 cm", "10 cm"}) add("jumps", robust, fmt::format("{{depth_jump: {}}}", jump));
  return all;
}

/// Where constant velocity puts the camera.
Pose predicted(const Pose& before_last, const Pose& last) {
  return last * before_last.inverse() * last;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "true_pose_weight FOLDER [FRAMES [PARTICLES]]\n");
    return 2;
  }
  const std::int64_t frames = argc > 2 ? std::atoll(argv[2]) : 1000;
  const auto particles = static_cast<std::size_t>(argc > 3 ? std::atoll(argv[3]) : 300);
  SevenScenesSettings source;
  source.path = argv[1];
  const SevenScenesSequence sequence(source);
  const FrameConditioning conditioning;
  test::Mapper mapper;
  const auto all = settings();
  Pose last = Pose::Identity(), before_last = Pose::Identity();
  fmt::print("study,module,params,frame,rank_nearest,rank_truth,kept,error,ess\n");
  for (std::int64_t index = 0; index < std::min(frames, sequence.size()); ++index) {
    const auto frame = std::make_shared<const Frame>(conditioning.apply(sequence.read(index), 2));
    const Pose truth = *frame->T_world_camera_ref, expected = predicted(before_last, last);
    before_last = last;
    last = truth;
    if (index % 10 != 5) {
      mapper.add(*frame);
      continue;
    }
    if (index < 20) continue;
    Rng rng(1, static_cast<std::uint32_t>(index), 0, purpose_key("true_pose_weight"));
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < particles; ++i) {
      Twist xi;
      for (int k = 0; k < 6; ++k) xi[k] = (k < 3 ? kSigmaT : kSigmaR) * rng.normal();
      poses.push_back(expected * se3_exp(xi));
    }
    poses.push_back(truth);
    std::vector<PredictionHandle> views;
    for (const auto& pose : poses)
      views.push_back(std::make_shared<const Prediction>(mapper.predict(frame->camera, pose, kStride)));
    for (const auto& w : all) w->weigh(frame, poses, views);
  }
}
