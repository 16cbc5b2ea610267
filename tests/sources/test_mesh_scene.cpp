#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

#include "modules/sources/house_plans.hpp"
#include "modules/sources/mesh_rays.hpp"
#include "modules/sources/mesh_sequence.hpp"
#include "tests/sources/ply_files.hpp"
#include "tests/sources/source_reader.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

/// A camera that stands before the two squares, 2 m from the larger, and looks at them.
class Squares {
 public:
  Squares() {
    write_text(folder_ / "squares.ply", two_squares());
    write_text(folder_ / "way.txt", "0 0 1 0 0\n0 0 1 0 0 20\n");
  }
  std::string params(const std::string& more) const {
    return "{file: " + (folder_ / "squares.ply").string() + ", waypoints: " + (folder_ / "way.txt").string() +
           ", sway: 0, fov: 60 deg" + more + "}";
  }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  TempFolder folder_;
};

bool same_bytes(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// The square that the centre of a pixel sees: 1 or 2 m away. border: pixels within this distance of the edge are 0.
double depth_seen(const Frame& frame, int x, int y, double border_px) {
  const double edge = 0.5 * frame.camera.fx, from_x = std::abs(x - frame.camera.cx), from_y = std::abs(y - frame.camera.cy);
  if (std::abs(std::max(from_x, from_y) - edge) < border_px) return 0;
  return from_x < edge && from_y < edge ? 1 : 2;
}

struct Errors {
  double n = 0, mean = 0, square = 0;
};

/// Of depth / expected - 1 over the frame's inner pixels, in units of sigma(expected) where sigma is not empty.
template <class Sigma>
Errors errors(const Frame& frame, double depth_m, Sigma sigma) {
  Errors e;
  for (int y = 0; y < frame.camera.rows; ++y)
    for (int x = 0; x < frame.camera.cols; ++x) {
      const auto i = static_cast<std::size_t>(y * frame.camera.cols + x);
      if (depth_seen(frame, x, y, 4) != depth_m || !frame.valid(static_cast<int>(i))) continue;
      const double v = (frame.depth[i] - depth_m) / sigma(i);
      e.n += 1, e.mean += v, e.square += v * v;
    }
  e.mean /= e.n, e.square /= e.n;
  return e;
}

}  // namespace

TEST_CASE("an exact camera sees the mesh") {
  const Squares squares;
  const auto frame = SourceReader("source.mesh_scene", squares.params(", noise: exact")).next();
  REQUIRE(frame->camera.cols == 176);
  CHECK(frame->camera.fx == Approx(88 / std::tan(EIGEN_PI / 6)));
  for (int y = 0; y < 144; ++y)
    for (int x = 0; x < 176; ++x) {
      const double seen = depth_seen(*frame, x, y, 0.01);
      if (seen > 0) CHECK(frame->depth[static_cast<std::size_t>(y * 176 + x)] == Approx(seen));
    }
  CHECK(frame->T_world_camera_ref->translation().isApprox(Eigen::Vector3d(0, 0, 1)));
}

TEST_CASE("the noise of a time-of-flight camera is what its sigma says, and its edges fly") {
  const Squares squares;
  const auto frame = SourceReader("source.mesh_scene", squares.params("")).next();
  for (const double depth : {1.0, 2.0}) {
    const Errors e = errors(*frame, depth, [&](std::size_t i) { return frame->sigma[i]; });
    INFO("at " << depth << " m");
    REQUIRE(e.n > 2000);
    CHECK(std::abs(e.mean) < 4 / std::sqrt(e.n));
    CHECK(e.square == Approx(1).margin(5 * std::sqrt(2 / e.n)));
  }
  int flying = 0;
  for (const float z : frame->depth) flying += z > 1.2 && z < 1.8;
  CHECK(flying > 50);
}

TEST_CASE("the noise of a Kinect has Nguyen's size and, if asked for, the steps of its disparity") {
  const Squares squares;
  const std::string kinect = ", camera: kinect320, frames: 1";
  const auto frame = SourceReader("source.mesh_scene", squares.params(kinect)).next();
  REQUIRE(frame->camera.cols == 320);
  for (const double depth : {1.0, 2.0}) {
    const double sigma = 0.0012 + 0.0019 * (depth - 0.4) * (depth - 0.4);
    const Errors e = errors(*frame, depth, [&](std::size_t) { return sigma; });
    INFO("at " << depth << " m");
    CHECK(std::abs(e.mean) < 4 / std::sqrt(e.n));
    CHECK(e.square == Approx(1).margin(5 * std::sqrt(2 / e.n)));
  }
  const auto steps = SourceReader("source.mesh_scene", squares.params(kinect + ", disparity_step: 0.125")).next();
  for (const float z : steps->depth) {
    const double disparity = 585 * 0.075 / z / 0.125;
    if (z == z) CHECK(disparity == Approx(std::round(disparity)));
  }
}

TEST_CASE("a simulated frame is the same bytes however it is read, and another seed is another noise") {
  const Squares squares;
  SourceReader forward("source.mesh_scene", squares.params(", frames: 4")), other("source.mesh_scene", squares.params(", seed: 2"));
  std::vector<std::shared_ptr<const Frame>> frames;
  while (auto frame = forward.next()) frames.push_back(frame);
  REQUIRE(frames.size() == 4);
  CHECK(frames[3]->stamp_s == Approx(0.3));
  for (const int i : {2, 0, 3}) CHECK(same_bytes(forward.image(i).depth, frames[static_cast<std::size_t>(i)]->depth));
  CHECK_FALSE(same_bytes(frames[0]->depth, frames[1]->depth));
  CHECK_FALSE(same_bytes(frames[0]->depth, other.next()->depth));
}

TEST_CASE("a trajectory's poses make the frames") {
  const Squares squares;
  write_text(squares / "path.tum", "10 0 0 1 -0.5 0.5 -0.5 0.5\n10.4 0.5 0 1 -0.5 0.5 -0.5 0.5\n");
  const std::string params = "{file: " + (squares / "squares.ply").string() +
                             ", trajectory: " + (squares / "path.tum").string() + ", noise: exact}";
  SourceReader reader("source.mesh_scene", params);
  const auto first = reader.next(), second = reader.next();
  REQUIRE(second);
  CHECK_FALSE(reader.next());
  const auto middle = static_cast<std::size_t>(72 * 176 + 88);
  CHECK(first->depth[middle] == Approx(1));
  CHECK(second->depth[middle] == Approx(0.5));
  CHECK(second->stamp_s == 10.4);
}

TEST_CASE("a scene that cannot be made is refused") {
  CHECK_THAT(data_error("source.mesh_scene", "{file: no/such.ply}"), Catch::Contains("no/such.ply: cannot be opened"));
  const Squares squares;
  CHECK_THAT(data_error("source.mesh_scene",
                        "{file: " + (squares / "squares.ply").string() + ", waypoints: no/such.txt}"),
             Catch::Contains("no/such.txt: cannot be opened"));
  for (const char* both : {"{waypoints: a, trajectory: b}", "{trajectory: b, waypoints: a}"})
    CHECK_THROWS_WITH(SourceReader("source.mesh_scene", both), Catch::Contains("give waypoints or a trajectory, not both"));
  CHECK_THROWS_WITH(SourceReader("source.mesh_scene", "{imu: true, trajectory: b}"), Catch::Contains("have no derivatives"));
}

TEST_CASE("the plans do what they are for") {
  const auto steps = [](HousePlan plan) { return sampled(CameraPath(house_plan(plan), {}), 10, -1); };
  const auto length = [](const std::vector<StampedPose>& path) {
    double sum = 0;
    for (std::size_t i = 1; i < path.size(); ++i)
      sum += (path[i].T_map_camera.translation() - path[i - 1].T_map_camera.translation()).norm();
    return sum;
  };
  const auto turn_deg = [](const std::vector<StampedPose>& path) {
    double most = 0;
    for (std::size_t i = 1; i < path.size(); ++i)
      most = std::max(most, rotation_angle(path[i - 1].T_map_camera.inverse() * path[i].T_map_camera));
    return most * 180 / std::numbers::pi;
  };
  const auto loop = steps(HousePlan::loop), fast = steps(HousePlan::fast_turn);
  CHECK(length(loop) > 30);
  CHECK(turn_deg(loop) < 6);
  // The loop's last metres are its first: the same place, the same direction.
  const Pose end = loop.back().T_map_camera;
  CHECK(std::ranges::any_of(std::span(loop).first(100), [&](const StampedPose& p) {
    const Pose step = p.T_map_camera.inverse() * end;
    return step.translation().norm() < 0.1 && rotation_angle(step) < 0.1;
  }));
  CHECK(length(steps(HousePlan::tour)) > 50);
  CHECK(turn_deg(fast) > 35);
  CHECK(CameraPath(house_plan(HousePlan::kidnap), {}).jumps_s().size() == 1);
}

TEST_CASE("the planned ways through the house touch nothing") {
  const auto file = data_path("house.ply");
  if (!file) return;
  const MeshRays rays(read_ply_mesh(*file));
  std::vector<Eigen::Vector3f> around;  // on a Fibonacci sphere
  for (int i = 0; i < 1000; ++i) {
    const double z = 1 - 2 * (i + 0.5) / 1000, a = i * 2.399963, r = std::sqrt(1 - z * z);
    around.push_back(Eigen::Vector3d(r * std::cos(a), r * std::sin(a), z).cast<float>());
  }
  std::vector<MeshHit> hit(around.size());
  for (const HousePlan plan : {HousePlan::loop, HousePlan::tour, HousePlan::corridor, HousePlan::fast_turn, HousePlan::kidnap}) {
    INFO("plan " << static_cast<int>(plan));
    for (const StampedPose& pose : sampled(CameraPath(house_plan(plan), {}), 5, -1)) {
      rays.cast(pose.T_map_camera.translation(), around, hit);
      const double clear_m = std::ranges::min_element(hit, {}, &MeshHit::range_m)->range_m;
      CAPTURE(pose.stamp_s, clear_m);
      REQUIRE(clear_m > 0.4);
    }
  }
}

TEST_CASE("the true surface of a mesh is the mesh") {
  const Squares squares;
  SourceReader reader("source.mesh_scene", squares.params(", noise: exact"));
  const Frame frame = reader.image(0);
  const auto truth = reader.source().true_surface();
  REQUIRE(truth);
  const Pose& T = *frame.T_world_camera_ref;
  const Eigen::Vector3d ahead = T.linear().col(2);
  std::vector<Eigen::Vector3f> direction{ahead.cast<float>(), -ahead.cast<float>()};
  std::vector<float> range(2);
  truth->cast(T.translation(), direction, range);
  CHECK(range[0] == Approx(1));
  CHECK(std::isinf(range[1]));
  CHECK(truth->distance(T.translation()) == Approx(1));
  CHECK(truth->distance(T.translation() + 0.9 * ahead) == Approx(0.1).epsilon(1e-4));
  CHECK(truth->distance(T.translation() + 1.9 * ahead) == Approx(0.1).epsilon(1e-4));
}
