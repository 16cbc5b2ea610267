// What prediction.shared_view does to weights: particles are drawn around the reference pose of every tenth frame of a
// source, all with the same map, which was made from the frames before with the reference poses, and weighed against
// exact views and against one shared view. Prints a table, one line a spread of the particles and a weighting:
// docs/results/shared_view.md.
//   shared_view_weights SOURCE PARAMETERS [FRAMES [PARTICLES [OPTIONS]]]
// OPTIONS: parameters of prediction.shared_view, as "detail: 2".
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fmt/core.h>

#include "framework/core/timing.hpp"
#include "framework/graph/harness.hpp"
#include "framework/slam/frame.hpp"
#include "tests/map_update/mapper.hpp"
#include "tests/support/registry.hpp"

using namespace ppm;

namespace {

struct Spread {
  double distance_m, angle_deg;  // standard deviations, of each axis
};
constexpr Spread kSpreads[] = {{0.001, 0.1}, {0.003, 0.2}, {0.01, 0.5}, {0.03, 1}, {0.1, 3}};

const std::string kWeightings[][2] = {{"weighting.gaussian", "{variance: texel_and_sensor}"},
                                      {"weighting.robust", "{pixels: 0}"},
                                      {"weighting.robust", "{}"}};

/// Views and weights of one back-end.
struct Way {
  Way(const std::string& look_module, const std::string& look_params, const std::string& weigh_module,
      const std::string& weigh_params)
      : look(test::builtin(), look_module, look_params), weigh(test::builtin(), weigh_module, weigh_params) {}

  void run(const std::shared_ptr<const Frame>& frame, const MapHandle& map, const std::vector<Pose>& poses) {
    const std::clock_t start = std::clock();  // the processor's time: one thread works
    look.belief().init(poses.size(), poses.front(), map);
    look.belief().pose = poses;
    look.input<Frame>("frame", frame);
    look.tick();
    weigh.belief().init(poses.size(), poses.front(), map);
    weigh.belief().pose = poses;
    weigh.belief().prediction = std::move(look.belief().prediction);
    weigh.input<Frame>("frame", frame);
    weigh.tick();
    ms.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / static_cast<double>(poses.size()));
    ess.push_back(weigh.belief().ess());
  }
  const std::vector<double>& log_weight() { return weigh.belief().log_weight; }

  Harness look, weigh;
  std::vector<double> ms, ess;
};

struct Line {
  Line(const Spread& s, const std::string& options, const std::string& weighting, const std::string& params)
      : spread(s),
        name(weighting + " " + params),
        exact("prediction.raster", "{}", weighting, params),
        shared("prediction.shared_view", "{distance_most: 1, angle_most: 28 deg, " + options + "}", weighting, params) {}

  void run(const std::shared_ptr<const Frame>& frame, const MapHandle& map, std::size_t particles) {
    Rng rng(1, static_cast<std::uint32_t>(frame->index), 0, purpose_key("shared_view_weights"));
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < particles; ++i) {
      Twist xi;
      for (int k = 0; k < 6; ++k)
        xi[k] = (k < 3 ? spread.distance_m : spread.angle_deg * EIGEN_PI / 180) * rng.normal();
      poses.push_back(*frame->T_world_camera_ref * se3_exp(xi));
    }
    exact.run(frame, map, poses);
    shared.run(frame, map, poses);
    compare(exact.log_weight(), shared.log_weight());
  }

  void compare(const std::vector<double>& a, const std::vector<double>& b) {
    const double n = static_cast<double>(a.size()), ma = mean(a), mb = mean(b);
    double aa = 0, bb = 0, ab = 0, off = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      aa += (a[i] - ma) * (a[i] - ma);
      bb += (b[i] - mb) * (b[i] - mb);
      ab += (a[i] - ma) * (b[i] - mb);
      off += std::pow(a[i] - ma - b[i] + mb, 2);
    }
    const auto best = static_cast<std::size_t>(std::max_element(a.begin(), a.end()) - a.begin());
    double better = 0;
    for (double value : b) better += value > b[best];
    correlation.push_back(ab / std::sqrt(aa * bb));
    slope.push_back(ab / aa);
    deviation.push_back(std::sqrt(aa / n));
    error.push_back(std::sqrt(off / n));
    rank.push_back(better + 1);
  }

  void print() const {
    fmt::print("| {:.0f} mm, {:.1f} deg | `{}` | {:.4f} | {:.4f} | {:.3f} | {:.2f} | {:.2f} | {:.1f} | {:.1f} | {:.0f} | {:.3f} | {:.3f} |\n",
               1000 * spread.distance_m, spread.angle_deg, name, quantile(correlation, 0.5),
               quantile(correlation, 0.1), quantile(slope, 0.5), quantile(deviation, 0.5), quantile(error, 0.5),
               quantile(exact.ess, 0.5), quantile(shared.ess, 0.5), quantile(rank, 0.5), quantile(exact.ms, 0.5),
               quantile(shared.ms, 0.5));
  }

  Spread spread;
  std::string name;
  Way exact, shared;
  std::vector<double> correlation, slope, deviation, error, rank;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "shared_view_weights SOURCE PARAMETERS [FRAMES [PARTICLES [OPTIONS]]]\n");
    return 2;
  }
  const int frames = argc > 3 ? std::atoi(argv[3]) : 300;
  const auto particles = static_cast<std::size_t>(argc > 4 ? std::atoll(argv[4]) : 200);
  const std::string options = argc > 5 ? argv[5] : "";
  Harness source(test::builtin(), argv[1], argv[2]);
  test::Mapper mapper;
  std::vector<std::unique_ptr<Line>> lines;
  for (const auto& spread : kSpreads)
    for (const auto& [module, params] : kWeightings) lines.push_back(std::make_unique<Line>(spread, options, module, params));
  for (int i = 0; i < frames && source.tick(); ++i) {
    const auto frame = source.output<Frame>("frame");
    if (i % 10 != 5) {
      mapper.add(*frame);
    } else if (i > 20) {
      for (auto& line : lines) line->run(frame, mapper.handle(), particles);
    }
  }
  fmt::print("{} particles, {} frames, at the end {} faces\n\n", particles, lines.front()->rank.size(),
             mapper.map().stats().faces);
  fmt::print(
      "| spread | weighting | correlation, median | 10 % | slope | deviation exact, nats | error, nats | ESS exact | shared "
      "| rank of the best | ms exact | shared |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& line : lines) line->print();
}
