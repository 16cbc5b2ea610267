#include <catch2/catch.hpp>

#include "framework/core/error.hpp"
#include "framework/slam/decimate.hpp"
#include "tests/preprocess/filtered.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

Frame image() {
  Frame f;
  f.index = 3;
  f.stamp_s = 1.5;
  f.camera = {5, 3, 10, 12, 2, 1};
  for (int i = 0; i < 15; ++i) {
    f.depth.push_back(1.0f + 0.1f * static_cast<float>(i));
    f.sigma.push_back(0.01f * static_cast<float>(i + 1));
    f.confidence.push_back(static_cast<float>(i));
    for (int c = 0; c < 3; ++c) f.color.push_back(static_cast<std::uint8_t>(3 * i + c));
  }
  f.lateral_px = 0.6f;
  f.T_world_camera_ref = Pose::Identity();
  return f;
}

}  // namespace

TEST_CASE("preprocess.decimate keeps each n-th pixel of all that the frame has") {
  const Frame in = image();
  const auto out = filtered("preprocess.decimate", "{stride: 2}", in);
  CHECK(out->index == 3);
  CHECK(out->stamp_s == 1.5);
  CHECK(out->T_world_camera_ref.has_value());
  CHECK(out->camera == in.camera.decimated(2));
  CHECK(out->confidence == std::vector<float>{0, 2, 4, 10, 12, 14});
  CHECK(out->depth[4] == in.depth[12]);
  CHECK(out->sigma[5] == in.sigma[14]);
  CHECK(out->color[9] == 30);
  CHECK(out->color.size() == 18);
  CHECK(out->lateral_px == 0.3f);
}

TEST_CASE("decimation by 1 changes nothing, and what a frame does not have it does not get") {
  Frame in = image();
  CHECK(filtered("preprocess.decimate", "{stride: 1}", in)->color == in.color);
  in.color.clear();
  in.confidence.clear();
  const Frame out = decimated(in, 3);
  CHECK(out.color.empty());
  CHECK(out.confidence.empty());
  CHECK(out.depth == std::vector<float>{in.depth[0], in.depth[3]});
}

TEST_CASE("a stride of nothing is refused, arrays that do not fit are a bug") {
  CHECK_THROWS_AS(filtered("preprocess.decimate", "{stride: 0}", image()), ConfigError);
  Frame in = image();
  in.sigma.pop_back();
  CHECK_THROWS_AS(decimated(in, 2), InternalError);
}
