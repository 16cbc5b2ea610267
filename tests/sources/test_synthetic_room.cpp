#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "modules/sources/room_path.hpp"
#include "modules/sources/room_scene.hpp"
#include "modules/sources/tof_camera.hpp"
#include "tests/sources/source_reader.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

bool same_bytes(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

Frame rendered(const AnalyticScene& room, const TofCamera& tof, std::int64_t index, std::uint64_t seed = 1) {
  Frame frame;
  frame.index = index;
  tof.render(room, room_camera_pose(static_cast<double>(index) / kRoomRateHz), seed, frame);
  return frame;
}

/// What the centre of a pixel sees.
SceneHit seen(const AnalyticScene& room, const Frame& frame, int x, int y) {
  const Pose T = room_camera_pose(static_cast<double>(frame.index) / kRoomRateHz);
  return room.cast(T.translation(), T.linear() * frame.camera.ray(x, y).normalized());
}

/// Whether all that the pixel and its neighbours see is one solid.
bool inner(const AnalyticScene& room, const Frame& frame, int x, int y) {
  const auto solid = seen(room, frame, x, y).solid;
  for (int v = y - 1; v <= y + 1; ++v)
    for (int u = x - 1; u <= x + 1; ++u)
      if (seen(room, frame, u, v).solid != solid) return false;
  return true;
}

}  // namespace

TEST_CASE("a frame of the room is the same bytes however it is read") {
  SourceReader forward("source.synthetic_room", "{frames: 6}"),
      jumps("source.synthetic_room", "{frames: 6, stride: 5}");
  std::vector<std::shared_ptr<const Frame>> frames;
  while (auto frame = forward.next()) frames.push_back(frame);
  REQUIRE(frames.size() == 6);
  jumps.next();
  const auto last = jumps.next();
  REQUIRE(last->index == 5);
  CHECK(same_bytes(last->depth, frames[5]->depth));
  CHECK(same_bytes(last->sigma, frames[5]->sigma));
  for (int i : {4, 1, 3}) CHECK(same_bytes(jumps.image(i).depth, frames[static_cast<std::size_t>(i)]->depth));
  CHECK(frames[3]->T_world_camera_ref->isApprox(room_camera_pose(3 / kRoomRateHz)));
  CHECK(frames[3]->stamp_s == Approx(0.2));
}

TEST_CASE("another seed is another noise in the same room") {
  const AnalyticScene room = make_room();
  const Frame a = rendered(room, {}, 40, 1), b = rendered(room, {}, 40, 2);
  CHECK_FALSE(same_bytes(a.depth, b.depth));
  CHECK(same_bytes(a.sigma, rendered(room, {}, 40, 1).sigma));
}

TEST_CASE("without noise and flying pixels the depth is the scene's") {
  const AnalyticScene room = make_room();
  TofCamera tof;
  tof.noise = 0;
  tof.flying_pixels = false;
  for (int index : {0, 77, 210}) {
    const Frame frame = rendered(room, tof, index);
    int valid = 0;
    for (int y = 0; y < frame.camera.rows; y += 3)
      for (int x = 0; x < frame.camera.cols; x += 3) {
        const int pixel = y * frame.camera.cols + x;
        if (!frame.valid(pixel)) continue;
        ++valid;
        const double z = seen(room, frame, x, y).range_m / frame.camera.ray(x, y).norm();
        CHECK(frame.depth[static_cast<std::size_t>(pixel)] == Approx(z).epsilon(1e-6));
      }
    CHECK(valid > 2500);
  }
}

TEST_CASE("noise on surfaces has the standard deviation that sigma says") {
  const AnalyticScene room = make_room();
  double sum = 0, square = 0, beyond_two = 0, n = 0;
  for (int index : {10, 60, 110, 160, 210, 260, 310}) {
    const Frame frame = rendered(room, {}, index);
    for (int y = 1; y < frame.camera.rows - 1; y += 2)
      for (int x = 1; x < frame.camera.cols - 1; x += 2) {
        const auto pixel = static_cast<std::size_t>(y * frame.camera.cols + x);
        if (!frame.valid(static_cast<int>(pixel)) || !inner(room, frame, x, y)) continue;
        const double z = seen(room, frame, x, y).range_m / frame.camera.ray(x, y).norm();
        const double e = (frame.depth[pixel] - z) / frame.sigma[pixel];
        sum += e, square += e * e, beyond_two += std::abs(e) > 2, ++n;
      }
  }
  REQUIRE(n > 25000);
  CHECK(std::abs(sum / n) < 4 / std::sqrt(n));
  CHECK(square / n == Approx(1).margin(4 * std::sqrt(2 / n)));
  CHECK(beyond_two / n == Approx(0.0455).margin(0.005));
}

TEST_CASE("sigma grows with range, grazing view and dark surfaces") {
  const TofCamera tof;
  CHECK(tof.range_sigma(1) == Approx(std::hypot(0.002, 0.0003)));
  CHECK(tof.range_sigma(0.02) == Approx(std::hypot(0.002, 0.015)));
  TofCamera loud;
  loud.noise = 3;
  CHECK(loud.range_sigma(0.1) == Approx(3 * tof.range_sigma(0.1)));
  TofCamera exact;
  exact.noise = 0;
  CHECK(exact.range_sigma(0.1) == 1e-4);
}

TEST_CASE("flying pixels are at edges only, between what meets there") {
  const AnalyticScene room = make_room();
  TofCamera tof;
  tof.noise = 0;
  int flying = 0;
  for (int index : {0, 90, 180, 270}) {
    const Frame frame = rendered(room, tof, index);
    for (int y = 1; y < frame.camera.rows - 1; ++y)
      for (int x = 1; x < frame.camera.cols - 1; ++x) {
        const auto pixel = static_cast<std::size_t>(y * frame.camera.cols + x);
        const double z = seen(room, frame, x, y).range_m / frame.camera.ray(x, y).norm();
        if (!frame.valid(static_cast<int>(pixel)) || std::abs(frame.depth[pixel] - z) < 0.03) continue;
        ++flying;
        CHECK_FALSE(inner(room, frame, x, y));
        double nearest = INFINITY, farthest = 0;
        for (int v = y - 1; v <= y + 1; ++v)
          for (int u = x - 1; u <= x + 1; ++u) {
            const double around = seen(room, frame, u, v).range_m / frame.camera.ray(x, y).norm();
            nearest = std::min(nearest, around), farthest = std::max(farthest, around);
          }
        CHECK(frame.depth[pixel] > nearest - 0.05);
        CHECK(frame.depth[pixel] < farthest + 0.05);
      }
  }
  CHECK(flying > 800);
  CHECK(flying < 6000);
}

TEST_CASE("every view holds the camera in all six directions and loses few pixels") {
  const AnalyticScene room = make_room();
  for (int index = 0; index < 380; index += 5) {
    const Frame frame = rendered(room, {}, index);
    const Pose T = room_camera_pose(index / kRoomRateHz);
    Eigen::Matrix<double, 6, 6> H = Eigen::Matrix<double, 6, 6>::Zero();
    int valid = 0, n = 0;
    for (int y = 0; y < frame.camera.rows; y += 4)
      for (int x = 0; x < frame.camera.cols; x += 4, ++n) {
        if (!frame.valid(y * frame.camera.cols + x)) continue;
        ++valid;
        const SceneHit hit = seen(room, frame, x, y);
        const Eigen::Vector3d p = hit.range_m * (T.linear() * frame.camera.ray(x, y).normalized());
        Eigen::Matrix<double, 6, 1> J;
        J << hit.normal, p.cross(hit.normal);
        H += J * J.transpose();
      }
    INFO("frame " << index);
    CHECK(valid > 0.85 * n);
    CHECK(Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(H / valid).eigenvalues()[0] > 0.008);
  }
}

TEST_CASE("colour is there when asked for") {
  CHECK(SourceReader("source.synthetic_room", "{frames: 1}").next()->color.empty());
  const auto frame = SourceReader("source.synthetic_room", "{frames: 1, color: true}").next();
  CHECK(frame->color.size() == frame->depth.size() * 3);
}

TEST_CASE("the room's true surface is what its exact images show") {
  SourceReader room("source.synthetic_room", "{frames: 2, noise: 0, flying_pixels: false}");
  const Frame frame = room.image(1);
  const auto truth = room.source().true_surface();
  REQUIRE(truth);
  std::vector<Eigen::Vector3f> direction;
  std::vector<double> expected;
  for (int i = 0; i < frame.camera.pixels(); i += 7) {
    if (!frame.valid(i)) continue;
    const Eigen::Vector3d ray = frame.camera.ray(i % frame.camera.cols, i / frame.camera.cols);
    const double depth = frame.depth[static_cast<std::size_t>(i)];
    direction.push_back((frame.T_world_camera_ref->linear() * ray.normalized()).cast<float>());
    expected.push_back(depth * ray.norm());
    CHECK(truth->distance(*frame.T_world_camera_ref * Eigen::Vector3d(depth * ray)) < 1e-5);
  }
  REQUIRE(direction.size() > 1000);
  std::vector<float> range(direction.size());
  truth->cast(frame.T_world_camera_ref->translation(), direction, range);
  for (std::size_t i = 0; i < range.size(); ++i) CHECK(range[i] == Approx(expected[i]).epsilon(1e-5));
  CHECK(truth->distance({0, 0, -0.03}) == Approx(0.03));  // within the floor
}
