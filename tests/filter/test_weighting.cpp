#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "framework/core/se3.hpp"
#include "framework/graph/harness.hpp"
#include "framework/slam/frame.hpp"
#include "modules/builtin.hpp"

using namespace ppm;

namespace {

Registry builtin() {
  Registry r;
  register_builtin(r);
  return r;
}

std::shared_ptr<Frame> wall_frame(const Camera& camera, float depth, float sigma) {
  auto frame = std::make_shared<Frame>();
  frame->camera = camera;
  frame->depth.assign(static_cast<std::size_t>(camera.pixels()), depth);
  frame->sigma.assign(static_cast<std::size_t>(camera.pixels()), sigma);
  return frame;
}

// The view of a plane z = depth of the camera frame whose texels say (mean, variance).
std::shared_ptr<Prediction> wall_view(const Camera& camera, const Pose& pose, double depth, float mean,
                                      float variance) {
  auto p = std::make_shared<Prediction>();
  p->reset(camera, 1, pose);
  const Eigen::Vector3f n = (pose.linear() * Eigen::Vector3d(0, 0, -1)).cast<float>();
  for (std::size_t i = 0; i < p->range.size(); ++i) {
    const auto cols = static_cast<std::size_t>(camera.cols);
    p->range[i] =
        static_cast<float>(depth * camera.ray(static_cast<double>(i % cols), static_cast<double>(i / cols)).norm());
    p->mean[i] = mean;
    p->variance[i] = variance;
    for (std::size_t k = 0; k < 3; ++k) p->normal[3 * i + k] = n[static_cast<Eigen::Index>(k)];
    p->chunk[i] = p->face[i] = 0;
  }
  return p;
}

void forget(Prediction& p, std::size_t pixel) {
  p.range[pixel] = Prediction::kMiss;
  p.mean[pixel] = p.variance[pixel] = 0;
  for (std::size_t k = 0; k < 3; ++k) p.normal[3 * pixel + k] = 0;
  p.chunk[pixel] = p.face[pixel] = Prediction::kNone;
}

// Difference of the log weights of two particles after one frame.
double log_odds(const std::string& module, const std::string& params, std::shared_ptr<const Frame> frame,
                std::shared_ptr<const Prediction> a, std::shared_ptr<const Prediction> b) {
  const Registry registry = builtin();
  Harness h(registry, module, params);
  h.belief().init(2, a->T_map_camera, nullptr);
  h.belief().prediction = {a, b};
  h.input<Frame>("frame", frame);
  h.tick();
  CHECK(std::exp(h.belief().log_weight[0]) + std::exp(h.belief().log_weight[1]) == Approx(1.0));
  return h.belief().log_weight[0] - h.belief().log_weight[1];
}

double log_normal(double x, double variance) {
  return -0.5 * (x * x / variance + std::log(2 * std::numbers::pi * variance));
}

double metric(Harness& h, const std::string& name) {
  for (const auto& [column, rows] : h.context().metrics().columns())
    if (column.ends_with("." + name)) return rows.back().value;
  FAIL("no metric " << name);
  return 0;
}

const Camera kTiny{3, 2, 4, 4, 1, 0.5};
const Pose kSomewhere = se3_exp((Twist() << 1, -2, 0.5, 0.3, -0.2, 0.7).finished());

}  // namespace

TEST_CASE("weighting.gaussian is the product of the texels' Gaussians along the rays") {
  const auto frame = wall_frame(kTiny, 2.0f, 0.02f);
  const auto a = wall_view(kTiny, kSomewhere, 2.01, 0.004f, 4e-4f),
             b = wall_view(kTiny, kSomewhere, 1.97, -0.01f, 9e-4f);
  const double sensor = GENERATE(0.0, 1.0);
  double expected = 0;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      const double length = kTiny.ray(x, y).norm(), c = 1 / length;  // the wall's normal is the optical axis
      const double s = sensor * std::pow(0.02 * length, 2);
      expected += log_normal(2.0 * length - (2.01 * length - 0.004 / c), 4e-4 / (c * c) + s);
      expected -= log_normal(2.0 * length - (1.97 * length + 0.01 / c), 9e-4 / (c * c) + s);
    }
  const std::string params = sensor > 0 ? "{variance: texel_and_sensor}" : "{}";
  CHECK(log_odds("weighting.gaussian", params, frame, a, b) == Approx(expected).epsilon(1e-4));
}

TEST_CASE("weighting.robust is the tempered mixture, with a density for misses") {
  const auto frame = wall_frame(kTiny, 2.0f, 0.02f);
  const auto a = wall_view(kTiny, kSomewhere, 2.03, 0.0f, 4e-4f);
  const auto b = wall_view(kTiny, kSomewhere, 2.5, 0.01f, 4e-4f);
  forget(*b, 4);
  double expected = 0;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      const double length = kTiny.ray(x, y).norm(), c2 = 1 / (length * length);
      const double lateral = 0.5 * 2.0 / 4.0;
      const double variance = std::pow(0.02 * length, 2) + (4e-4 + 0.01 * 0.01 + lateral * lateral * (1 - c2)) / c2;
      auto mixture = [&](double r) { return std::log(0.8 * std::exp(log_normal(r, variance)) + 0.2 / 8.0); };
      expected += mixture(2.0 * length - 2.03 * length);
      expected -= y == 1 && x == 1 ? std::log(0.05) : mixture(2.0 * length - (2.5 - 0.01) * length);
    }
  const double odds = log_odds("weighting.robust",
                               "{pixels: 0, temper: 0.5, outlier_share: 0.2, max_range: 8, miss_density: 0.05, "
                               "model_sigma: 1 cm, depth_jump: 0}",
                               frame, a, b);
  CHECK(odds == Approx(0.5 * expected).epsilon(1e-4));
}

TEST_CASE("every block of a view counts, the last one too") {
  const Camera camera{60, 40, 1e5, 1e5, 29.5, 19.5}, pixel{1, 1, 1e5, 1e5, 0, 0};  // all rays along the optical axis
  const std::string module = GENERATE("weighting.gaussian", "weighting.robust");
  auto odds = [&](const Camera& c) {
    return log_odds(module, module == "weighting.robust" ? "{pixels: 0}" : "{}", wall_frame(c, 2.0f, 0.02f),
                    wall_view(c, kSomewhere, 2.001, 0.0f, 4e-4f), wall_view(c, kSomewhere, 2.002, 0.0f, 4e-4f));
  };
  CHECK(odds(camera) == Approx(2400 * odds(pixel)).epsilon(2e-3));
}

TEST_CASE("the particle that is right wins") {
  const std::string module = GENERATE("weighting.gaussian", "weighting.robust");
  const Camera camera{40, 30, 40, 40, 19.5, 14.5};
  const auto frame = wall_frame(camera, 2.0f, 0.01f);
  const auto right = wall_view(camera, kSomewhere, 2.002, 0.0f, 1e-4f),
             wrong = wall_view(camera, kSomewhere, 2.06, 0.0f, 1e-4f);
  CHECK(log_odds(module, "{}", frame, right, wrong) > 3);
  CHECK(log_odds(module, "{}", frame, wrong, right) < -3);
  CHECK(log_odds(module, "{}", frame, right, right) == Approx(0.0).margin(1e-12));
}

TEST_CASE("a particle that looks away from its map does not win with the density for misses, and does without") {
  const Camera camera{40, 30, 40, 40, 19.5, 14.5};
  const auto frame = wall_frame(camera, 2.0f, 0.01f);
  // A surface that is known badly: the paper's product of densities is then below 1, the empty product's value.
  const auto right = wall_view(camera, kSomewhere, 2.002, 0.0f, 1.0f),
             away = wall_view(camera, kSomewhere, 2.0, 0.0f, 1.0f);
  for (std::size_t i = 0; i < away->range.size(); ++i)
    if (i % 40 > 5) forget(*away, i);
  CHECK(log_odds("weighting.robust", "{}", frame, right, away) > 1);
  CHECK(log_odds("weighting.gaussian", "{}", frame, right, away) < -1);
}

TEST_CASE("weights do not depend on the map's place, nor on a constant factor of earlier weights") {
  const std::string module = GENERATE("weighting.gaussian", "weighting.robust");
  const auto frame = wall_frame(kTiny, 2.0f, 0.02f);
  auto odds_at = [&](const Pose& pose) {
    return log_odds(module, "{}", frame, wall_view(kTiny, pose, 2.01, 0.001f, 4e-4f),
                    wall_view(kTiny, pose, 1.97, 0, 4e-4f));
  };
  CHECK(odds_at(kSomewhere) == Approx(odds_at(Pose::Identity())).epsilon(1e-4));

  const Registry registry = builtin();
  std::vector<std::vector<double>> weights;
  for (double constant : {0.0, -700.0}) {
    Harness h(registry, module);
    h.belief().init(2, kSomewhere, nullptr);
    h.belief().log_weight = {std::log(0.25) + constant, std::log(0.75) + constant};
    h.belief().prediction = {wall_view(kTiny, kSomewhere, 2.01, 0, 4e-4f),
                             wall_view(kTiny, kSomewhere, 2.02, 0, 4e-4f)};
    h.input<Frame>("frame", frame);
    h.tick();
    weights.push_back(h.belief().log_weight);
  }
  CHECK(weights[0][0] == Approx(weights[1][0]).margin(1e-9));
  CHECK(weights[0][1] == Approx(weights[1][1]).margin(1e-9));
}

TEST_CASE("residuals of kilometres and certain maps do not overflow") {
  const std::string module = GENERATE("weighting.gaussian", "weighting.robust");
  const Camera camera{40, 30, 40, 40, 19.5, 14.5};
  const auto frame = wall_frame(camera, 2.0f, 0.001f);
  const auto near = wall_view(camera, kSomewhere, 5e3, 0, 0.0f), far = wall_view(camera, kSomewhere, 1e4, 0, 0.0f);
  const double odds = log_odds(module, "{}", frame, near, far);
  CHECK(std::isfinite(odds));
  CHECK(odds >= 0);
}

TEST_CASE("nothing to compare leaves the weights alone and says so") {
  const std::string module = GENERATE("weighting.gaussian", "weighting.robust");
  const std::string what = GENERATE("no return", "empty maps", "no number");
  CAPTURE(module, what);
  const auto frame = wall_frame(kTiny, what == "no return" ? NAN : 2.0f, 0.02f);
  const auto view = wall_view(kTiny, kSomewhere, 2.0, what == "no number" ? NAN : 0.f, 4e-4f);
  if (what == "empty maps")
    for (std::size_t i = 0; i < view->range.size(); ++i) forget(*view, i);
  const Registry registry = builtin();
  Harness h(registry, module);
  h.belief().init(2, kSomewhere, nullptr);
  h.belief().log_weight = {std::log(0.25), std::log(0.75)};
  h.belief().prediction = {view, view};
  h.input<Frame>("frame", frame);
  h.tick();
  CHECK(h.belief().log_weight == std::vector<double>{std::log(0.25), std::log(0.75)});
  CHECK(metric(h, "degenerate") == 1.0);
}

TEST_CASE("a particle whose view is no number loses all its weight, the others none") {
  const std::string module = GENERATE("weighting.gaussian", "weighting.robust");
  const auto frame = wall_frame(kTiny, 2.0f, 0.02f);
  const Registry registry = builtin();
  Harness h(registry, module);
  h.belief().init(2, kSomewhere, nullptr);
  h.belief().prediction = {wall_view(kTiny, kSomewhere, 2.0, NAN, 4e-4f), wall_view(kTiny, kSomewhere, 2.0, 0, 4e-4f)};
  h.input<Frame>("frame", frame);
  h.tick();
  CHECK(std::exp(h.belief().log_weight[0]) == 0.0);
  CHECK(h.belief().log_weight[1] == Approx(0.0).margin(1e-12));
  CHECK(metric(h, "degenerate") == 0.0);
}

TEST_CASE("metrics describe the best particle") {
  const Camera camera{40, 30, 40, 40, 19.5, 14.5};
  const auto frame = wall_frame(camera, 2.0f, 0.001f);
  const auto view = wall_view(camera, kSomewhere, 2.0, 0, 1e-6f);
  for (std::size_t i = 0; i < 300; ++i) forget(*view, i);          // 25 % of the pixels
  for (std::size_t i = 300; i < 570; ++i) view->range[i] += 1.0f;  // 30 % of the hits
  const Registry registry = builtin();
  Harness h(registry, "weighting.robust", "{pixels: 0}");
  h.belief().init(3, kSomewhere, nullptr);
  h.belief().prediction = {view, view, view};
  h.input<Frame>("frame", frame);
  h.tick();
  CHECK(metric(h, "ess") == Approx(3.0));
  CHECK(metric(h, "entropy") == Approx(std::log(3.0)));
  CHECK(metric(h, "miss_share") == Approx(0.25));
  CHECK(metric(h, "outlier_share") == Approx(0.3));
  CHECK(metric(h, "residual") == Approx(0.3).epsilon(1e-3));
}

TEST_CASE("metrics count misses over all particles by weight, and normalise the residuals of the best") {
  const Camera camera{40, 30, 4000, 4000, 19.5, 14.5};  // so narrow that all rays meet the wall head-on
  const auto frame = wall_frame(camera, 2.003f, 0.002f);
  const auto whole = wall_view(camera, kSomewhere, 2.0, 0, 4e-6f), half = wall_view(camera, kSomewhere, 2.0, 0, 4e-6f);
  for (std::size_t i = 0; i < 600; ++i) forget(*half, i);
  const Registry registry = builtin();
  Harness h(registry, "weighting.robust", "{pixels: 0, temper: 0.0005}");
  h.belief().init(2, kSomewhere, nullptr);
  h.belief().prediction = {whole, half};
  h.input<Frame>("frame", frame);
  h.tick();
  const double of_half = std::exp(h.belief().log_weight[1]);
  REQUIRE(of_half > 0.05);
  REQUIRE(of_half < 0.5);
  CHECK(metric(h, "miss_weight") == Approx(0.5 * of_half));
  CHECK(metric(h, "miss_share") == 0);
  CHECK(metric(h, "innovation_mean") == Approx(0.003 / std::sqrt(8e-6)).epsilon(0.01));
  CHECK(metric(h, "innovation_variance") == Approx(0).margin(1e-3));
}

TEST_CASE("a target for the ESS tempers frames that say too much, within its bound, and no others") {
  const Registry registry = builtin();
  const auto weigh = [&](const std::string& params, double apart_m) {
    Harness h(registry, "weighting.gaussian", params);
    h.belief().init(10, kSomewhere, nullptr);
    for (std::size_t i = 0; i < 10; ++i)
      h.belief().prediction[i] = wall_view(kTiny, kSomewhere, 2 + apart_m * static_cast<double>(i), 0, 1e-4f);
    h.input<Frame>("frame", wall_frame(kTiny, 2, 0.01f));
    h.tick();
    const auto& columns = h.context().metrics().columns();
    const auto temper = columns.find("weighting.gaussian.temper");
    return std::pair(h.belief().ess(), temper == columns.end() ? -1.0 : temper->second.back().value);
  };
  const auto [free_ess, none] = weigh("{}", 0.02);
  CHECK(free_ess < 1.5);
  CHECK(none == -1);
  const auto [ess, temper] = weigh("{ess_target: 0.5, temper_least: 0.001}", 0.02);
  CHECK(ess == Approx(5).epsilon(1e-6));
  CHECK(temper < 1);
  const auto [bounded_ess, bound] = weigh("{ess_target: 0.5, temper_least: 0.4}", 0.02);
  CHECK(bound == 0.4);
  CHECK(bounded_ess < 5);
  CHECK(weigh("{ess_target: 0.5}", 1e-4).second == 1);
}
