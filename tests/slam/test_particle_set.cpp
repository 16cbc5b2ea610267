#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "framework/slam/particle_set.hpp"

namespace {

class NumberedMap final : public ppm::Map {
 public:
  explicit NumberedMap(int number) : number_(number) {}
  int number() const { return number_; }
  std::string_view kind() const override { return "numbered"; }
  ppm::MapStats stats() const override { return {}; }
  std::int64_t account(std::unordered_set<const void*>&) const override { return 0; }
  void digest(ppm::Digest&) const override {}
  ppm::Mesh mesh(ppm::Surface) const override { return {}; }

 private:
  int number_;
};

int number_of(const ppm::MapHandle& map) {
  return dynamic_cast<const NumberedMap&>(*map).number();
}

/// A particle with nothing shared: the oracle.
struct Plain {
  double x, log_weight, velocity;
  int map;
  std::vector<double> path;
};

std::vector<Plain> plain_copy(ppm::ParticleSet& set) {
  std::vector<Plain> out;
  for (std::size_t i = 0; i < set.size(); ++i) {
    Plain p{set.pose[i].translation().x(),
            set.log_weight[i],
            set.column<double>("test/velocity")[i],
            number_of(set.map[i]),
            {}};
    for (const auto& s : set.trajectory[i].poses()) p.path.push_back(s.T_map_camera.translation().x());
    out.push_back(p);
  }
  return out;
}

void check_equal(const std::vector<Plain>& a, const std::vector<Plain>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(a[i].x == b[i].x);
    REQUIRE(a[i].log_weight == b[i].log_weight);
    REQUIRE(a[i].velocity == b[i].velocity);
    REQUIRE(a[i].map == b[i].map);
    REQUIRE(a[i].path == b[i].path);
  }
}

ppm::Pose shifted(double x) {
  ppm::Pose T = ppm::Pose::Identity();
  T.translation().x() = x;
  return T;
}

}  // namespace

TEST_CASE("random gathers and edits agree with particles that share nothing") {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    ppm::ParticleSet set;
    const std::size_t n = 1 + random() % 12;
    set.init(n, shifted(0.5), std::make_shared<NumberedMap>(0));
    auto& velocity = set.column<double>("test/velocity");
    std::vector<Plain> oracle(n, Plain{0.5, -std::log(static_cast<double>(n)), 0.0, 0, {}});
    for (int step = 1; step < 200; ++step) {
      const std::size_t i = random() % set.size();
      const double value = static_cast<double>(random() % 1000);
      switch (random() % 6) {
        case 0:
          set.extend(i, {step, 0.1 * step, shifted(value)});
          oracle[i].x = value;
          oracle[i].path.push_back(value);
          break;
        case 1:
          if (set.trajectory[i].empty()) break;
          set.correct(i, shifted(value));
          oracle[i].x = oracle[i].path.back() = value;
          break;
        case 2:
          set.map[i] = std::make_shared<NumberedMap>(step);
          oracle[i].map = step;
          break;
        case 3:
          velocity[i] = oracle[i].velocity = value;
          break;
        case 4:
          set.log_weight[i] = oracle[i].log_weight = -value;
          break;
        default: {
          std::vector<std::uint32_t> ancestors(1 + random() % 12);
          for (auto& a : ancestors) a = static_cast<std::uint32_t>(random() % set.size());
          set.gather(ancestors);
          std::vector<Plain> next;
          for (auto a : ancestors) next.push_back(oracle[a]);
          oracle = next;
        }
      }
    }
    check_equal(plain_copy(set), oracle);
  }
}

TEST_CASE("a correction replaces the pose of this frame and keeps frame and stamp") {
  ppm::ParticleSet set;
  set.init(2, shifted(0), nullptr);
  for (std::size_t i = 0; i < 2; ++i) set.extend(i, {0, 0.0, shifted(0)});
  set.extend(0, {3, 0.3, shifted(1)});
  set.correct(0, shifted(2));
  REQUIRE(set.trajectory[0].length() == 2);
  CHECK(set.trajectory[0].last().frame == 3);
  CHECK(set.trajectory[0].last().stamp_s == 0.3);
  CHECK(set.trajectory[0].last().T_map_camera.translation().x() == 2);
  CHECK(set.pose[0].translation().x() == 2);
  CHECK(set.trajectory[1].length() == 1);
}

TEST_CASE("normalising gives weights that sum to one, and the log of their sum before") {
  ppm::ParticleSet set;
  set.init(3, shifted(0), nullptr);
  set.log_weight = {-10000.0, -10000.0 + std::log(3.0), -std::numeric_limits<double>::infinity()};
  CHECK(set.normalize() == Approx(-10000.0 + std::log(4.0)));
  CHECK(std::exp(set.log_weight[0]) == Approx(0.25));
  CHECK(std::exp(set.log_weight[1]) == Approx(0.75));
  CHECK(std::exp(set.log_weight[2]) == 0);
  CHECK(set.ess() == Approx(1 / (0.0625 + 0.5625)));
  CHECK(set.best() == 1);
}

TEST_CASE("the effective sample size lies between one and the number of particles") {
  ppm::ParticleSet set;
  set.init(50, shifted(0), nullptr);
  CHECK(set.ess() == Approx(50));
  CHECK(set.ess() <= 50);
  CHECK(set.best() == 0);
  set.log_weight.assign(50, -std::numeric_limits<double>::infinity());
  set.log_weight[17] = 0;
  CHECK(set.ess() == 1);
  CHECK(set.best() == 17);
}

TEST_CASE("weights without a finite one are a bug that is told") {
  ppm::ParticleSet set;
  set.init(2, shifted(0), nullptr);
  set.log_weight.assign(2, -std::numeric_limits<double>::infinity());
  CHECK_THROWS_AS(set.normalize(), ppm::InternalError);
  set.log_weight = {0.0, std::numeric_limits<double>::quiet_NaN()};
  CHECK_THROWS_AS(set.normalize(), ppm::InternalError);
}

TEST_CASE("a column keeps its type, and ancestors must exist") {
  ppm::ParticleSet set;
  set.init(2, shifted(0), nullptr);
  set.column<double>("a");
  CHECK_THROWS_AS(set.column<int>("a"), ppm::InternalError);
  CHECK_THROWS_AS(set.gather({0, 2}), ppm::InternalError);
  CHECK_THROWS_AS(set.gather({}), ppm::InternalError);
}
