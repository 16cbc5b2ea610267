#include <catch2/catch.hpp>
#include <numeric>

#include "framework/slam/view_fit.hpp"
#include "tests/support/resampling.hpp"

using namespace ppm;

namespace {

const std::string kAll[] = {"resampling.systematic", "resampling.stratified", "resampling.residual",
                            "resampling.multinomial"};

/// A belief whose particles stand `spacing` apart on a line, with equal weights.
void stand_apart(ParticleSet& belief, std::size_t n, double spacing_m) {
  belief.init(n, Pose::Identity(), nullptr);
  for (std::size_t i = 0; i < n; ++i)
    belief.extend(i, {0, 0, Pose(Eigen::Translation3d(spacing_m * static_cast<double>(i), 0, 0))});
}

void set_outliers(ParticleSet& belief, float share) {
  for (auto& fit : belief.column<ViewFit>(kViewFitColumn).values) fit.outliers = share;
}

std::string message_of(const std::string& params, bool with_fit = true) {
  Harness h(test::builtin(), "resampling.systematic", params);
  stand_apart(h.belief(), 5, 0);
  if (with_fit) set_outliers(h.belief(), 0);
  try {
    h.tick();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("another number of particles: each gets n w copies on average, by every draw") {
  const std::vector<double> weights{0.05, 0.31, 0.02, 0.24, 0.11, 0.27};
  for (const auto& module : kAll) {
    for (int n : {3, 6, 25}) {
      CAPTURE(module, n);
      constexpr int runs = 1500;
      std::vector<double> sum(weights.size()), square(weights.size());
      for (std::uint64_t seed = 0; seed < runs; ++seed) {
        const auto count = test::copies(weights, seed, module, fmt::format("{{ess_below: 1, number: fixed, particles: {}}}", n));
        REQUIRE(std::accumulate(count.begin(), count.end(), 0) == n);
        for (std::size_t i = 0; i < weights.size(); ++i) {
          sum[i] += count[i];
          square[i] += count[i] * count[i];
        }
      }
      for (std::size_t i = 0; i < weights.size(); ++i) {
        const double mean = sum[i] / runs, variance = square[i] / runs - mean * mean;
        CHECK(std::abs(mean - n * weights[i]) <= 4 * std::sqrt(variance / runs) + 4e-3);
      }
    }
  }
}

TEST_CASE("a fixed number comes back whatever the weights are, and stays where they are even") {
  Harness h(test::builtin(), "resampling.systematic", "{number: fixed, particles: 8}");
  stand_apart(h.belief(), 20, 1);
  h.tick();
  CHECK(h.belief().size() == 8);
  for (double w : h.belief().log_weight) CHECK(w == Approx(-std::log(8.0)));
  const auto poses = h.belief().trajectory;
  h.tick();
  CHECK(h.belief().trajectory == poses);
  const auto& metrics = h.context().metrics().columns();
  CHECK(metrics.at("resampling.systematic.particles").front().value == 20);
  CHECK(metrics.at("resampling.systematic.drawn").front().value == 8);
  CHECK(metrics.at("resampling.systematic.resampled").back().value == 0);
}

TEST_CASE("KLD-sampling asks for many particles where they are spread, and few where they agree") {
  Harness h(test::builtin(), "resampling.systematic", "{number: kld, least: 15, most: 300, fall: 1}");
  stand_apart(h.belief(), 30, 0.1);
  h.tick();
  CHECK(h.belief().size() == 300);  // 30 bins need more
  for (auto& pose : h.belief().pose) pose = Pose::Identity();
  h.tick();
  CHECK(h.belief().size() == 15);
}

TEST_CASE("the number that is needed follows the outliers of the best view") {
  std::vector<std::size_t> numbers;
  for (float outliers : {0.0f, 0.05f, 0.07f, 0.09f, 0.11f, 0.13f, 0.6f}) {
    Harness h(test::builtin(), "resampling.systematic", "{number: need, least: 20, most: 500, fall: 1, slack: 0}");
    stand_apart(h.belief(), 40, 0);
    set_outliers(h.belief(), outliers);
    h.tick();
    numbers.push_back(h.belief().size());
  }
  CHECK(numbers.front() == 20);
  CHECK(numbers[1] == 20);
  CHECK(numbers[3] == 100);  // half way: the geometric mean
  CHECK(numbers[5] == 500);
  CHECK(numbers.back() == 500);
  CHECK(std::ranges::is_sorted(numbers));
}

TEST_CASE("a belief that is lost needs few particles: they stand for nothing") {
  for (const std::string number : {"need", "kld"}) {
    Harness h(test::builtin(), "resampling.systematic", "{number: " + number + ", least: 20, most: 500, fall: 1}");
    stand_apart(h.belief(), 40, 1);
    set_outliers(h.belief(), 0.9f);
    h.belief().lost = true;
    h.tick();
    CHECK(h.belief().size() == 20);
  }
}

TEST_CASE("the number that is needed counts the places in question, not those without weight") {
  Harness h(test::builtin(), "resampling.systematic", "{number: need, least: 5, most: 500, per_place: 10, fall: 1, slack: 0}");
  stand_apart(h.belief(), 12, 1);
  set_outliers(h.belief(), 0);
  h.belief().log_weight.assign(12, -1000.0);
  for (std::size_t i : {2u, 5u, 9u}) h.belief().log_weight[i] = 0;
  h.belief().normalize();
  h.tick();
  CHECK(h.belief().size() == 30);
}

TEST_CASE("a number that is needed no more goes by a share of the surplus a frame, and small changes are left") {
  Harness h(test::builtin(), "resampling.systematic", "{number: need, least: 20, most: 500, fall: 0.5, slack: 0.2}");
  stand_apart(h.belief(), 100, 0);
  set_outliers(h.belief(), 0);
  std::vector<std::size_t> numbers;
  for (int frame = 0; frame < 6; ++frame) {
    h.tick();
    numbers.push_back(h.belief().size());
  }
  CHECK(numbers == std::vector<std::size_t>{60, 40, 30, 25, 25, 25});  // within the slack of 20
  set_outliers(h.belief(), 1);
  h.tick();
  CHECK(h.belief().size() == 500);
}

TEST_CASE("numbers of particles that contradict each other are refused") {
  using Catch::Contains;
  CHECK_THAT(message_of("{number: fixed}"), Contains("needs the parameter 'particles'"));
  CHECK_THAT(message_of("{particles: 10}"), Contains("the number is not `number: fixed`"));
  CHECK_THAT(message_of("{number: need, least: 10, most: 5}"), Contains("'least' (10) is above 'most' (5)"));
  CHECK_THAT(message_of("{number: need, outliers_few: 0.2}"), Contains("'outliers_few' (0.2) is not below"));
  CHECK_THAT(message_of("{number: need}", false), Contains("a 'weighting.*' does"));
  CHECK(message_of("{number: need}") == "");
}
