#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "framework/core/error.hpp"
#include "framework/graph/harness.hpp"
#include "framework/slam/tum_trajectory.hpp"
#include "tests/support/registry.hpp"
#include "tests/support/temp_folder.hpp"

namespace {

ppm::Pose shifted(double x) {
  ppm::Pose T = ppm::Pose::Identity();
  T.translation().x() = x;
  return T;
}

std::vector<double> positions(const std::filesystem::path& file) {
  std::vector<double> x;
  for (const auto& p : ppm::read_tum(file)) x.push_back(p.T_map_camera.translation().x());
  return x;
}

/// Three frames; particle 0 (at 1, 2, 3) is best at first, particle 1 (at 10, 20, 30) at the last frame.
void drive(ppm::Harness& h) {
  auto& belief = h.belief();
  belief.init(2, shifted(0), nullptr);
  for (int k = 1; k <= 3; ++k) {
    belief.extend(0, {k, 0.1 * k, shifted(k)});
    belief.extend(1, {k, 0.1 * k, shifted(10 * k)});
    belief.log_weight = k < 3 ? std::vector<double>{-0.1, -2.4} : std::vector<double>{-2.4, -0.1};
    h.tick();
  }
}

}  // namespace

TEST_CASE("the trajectory sink writes the best path in hindsight and the best pose of each frame") {
  ppm::test::TempFolder out;
  ppm::Harness h(ppm::test::builtin(), "sink.trajectory_tum", "{}", 1, 1, out.path());
  drive(h);
  CHECK(std::filesystem::is_empty(out.path()));  // nothing before the end
  h.close();
  CHECK(positions(out / "trajectory.tum") == std::vector<double>{10, 20, 30});
  CHECK(positions(out / "trajectory_online.tum") == std::vector<double>{1, 2, 30});
  CHECK(std::distance(std::filesystem::directory_iterator(out.path()), {}) == 2);  // no half-written file stays
}

TEST_CASE("the online path is of the pose that is asked for") {
  auto online = [](const std::string& estimate) {
    ppm::test::TempFolder out;
    ppm::Harness h(ppm::test::builtin(), "sink.trajectory_tum", "{online: " + estimate + "}", 1, 1, out.path());
    drive(h);
    h.close();
    CHECK(positions(out / "trajectory.tum") == std::vector<double>{10, 20, 30});
    return positions(out / "trajectory_online.tum");
  };
  CHECK(online("best") == std::vector<double>{1, 2, 30});
  const double light = std::exp(-2.4), heavy = std::exp(-0.1);  // they sum to 1, about
  const auto mean = online("mean");
  CHECK(mean[0] == Approx(heavy * 1 + light * 10).epsilon(0.01));
  CHECK(mean[2] == Approx(heavy * 30 + light * 3).epsilon(0.01));
  const auto mode = online("mode");
  CHECK(mode[0] < mean[0]);
  CHECK(mode[2] > mean[2]);
  CHECK_THROWS_AS(online("median"), ppm::ConfigError);
}

TEST_CASE("the trajectory sink takes file names, and says where it cannot write") {
  ppm::test::TempFolder out;
  ppm::Harness named(ppm::test::builtin(), "sink.trajectory_tum", "{file: a.tum, online_file: b.tum}", 1, 1,
                     out.path());
  drive(named);
  named.close();
  CHECK(std::filesystem::exists(out / "a.tum"));
  CHECK(std::filesystem::exists(out / "b.tum"));

  ppm::Harness nowhere(ppm::test::builtin(), "sink.trajectory_tum", "{}", 1, 1, out / "absent");
  drive(nowhere);
  CHECK_THROWS_AS(nowhere.close(), ppm::OutputError);
}
