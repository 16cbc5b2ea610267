#include <catch2/catch.hpp>

#include "framework/graph/harness.hpp"
#include "framework/roles/map_update.hpp"
#include "tests/roles/toy_maps.hpp"

namespace {

using namespace ppm::test;

/// Adds 100 at keyframes and 1 between them.
struct Counts final : ppm::MapUpdate {
  Counts() : MapUpdate({{"map.number"}, {}, {}}) { add_keyframe_params(); }

 protected:
  ppm::MapHandle learn(ppm::Context&, std::size_t, ppm::MapHandle map, int) override {
    return number_map(number_of(*map) + 100);
  }
  ppm::MapHandle between(ppm::Context&, std::size_t, ppm::MapHandle map, int) override {
    return number_map(number_of(*map) + 1);
  }
};

const ppm::Registry& toys() {
  static const ppm::Registry registry = [] {
    ppm::Registry r;
    r.add<Counts>("map_update.counts", "Counts.", "made up");
    return r;
  }();
  return registry;
}

/// Two rows of two pixels, one without a return.
std::shared_ptr<ppm::Frame> small_frame() {
  auto frame = std::make_shared<ppm::Frame>();
  frame->camera.rows = frame->camera.cols = 2;
  frame->camera.fx = frame->camera.fy = 1;
  frame->depth = {1, 1, 1, std::numeric_limits<float>::quiet_NaN()};
  frame->sigma.assign(4, 0.01f);
  return frame;
}

std::shared_ptr<ppm::Prediction> view_with_misses(const ppm::Frame& frame, std::vector<std::size_t> misses) {
  auto view = std::make_shared<ppm::Prediction>();
  view->reset(frame.camera, 1, ppm::Pose::Identity());
  std::fill(view->chunk.begin(), view->chunk.end(), 0u);
  for (auto i : misses) view->chunk[i] = ppm::Prediction::kNone;
  return view;
}

}  // namespace

TEST_CASE("every n-th mapped frame is a keyframe, and frames that teach nothing do not count") {
  ppm::Harness h(toys(), "map_update.counts", "{keyframe_every: 3}");
  h.belief().init(1, shifted(0), number_map(0));
  auto number_after = [&](bool held_out, bool lost) {
    auto frame = small_frame();
    frame->held_out = held_out;
    h.belief().lost = lost;
    h.input<ppm::Frame>("frame", frame);
    h.tick();
    return number_of(*h.belief().map[0]);
  };
  CHECK(number_after(false, false) == 100);
  CHECK(number_after(true, false) == 100);
  CHECK(number_after(false, true) == 100);
  CHECK(number_after(false, false) == 101);
  CHECK(number_after(false, false) == 102);
  CHECK(number_after(false, false) == 202);
}

TEST_CASE("a frame becomes a keyframe for the particles that moved or turned or whose map shows too little") {
  ppm::Harness h(toys(), "map_update.counts", "{keyframe_every: 1000, keyframe_distance: 10 cm, keyframe_angle: 10 deg, keyframe_misses: 0.5}");
  auto& belief = h.belief();
  belief.init(4, shifted(0), number_map(0));
  const auto frame = small_frame();
  h.input<ppm::Frame>("frame", frame);
  h.tick();
  for (const auto& map : belief.map) REQUIRE(number_of(*map) == 100);
  belief.pose[1] = shifted(0.11);
  belief.pose[2].rotate(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()));
  belief.prediction[0] = view_with_misses(*frame, {0, 3});     // one of three measured pixels
  belief.prediction[3] = view_with_misses(*frame, {0, 2, 3});  // two of three
  h.tick();
  std::vector<int> numbers;
  for (const auto& map : belief.map) numbers.push_back(number_of(*map));
  CHECK(numbers == std::vector<int>{101, 200, 200, 200});
  h.tick();  // all stand where their last keyframe was, but the first, which is near enough
  numbers.clear();
  for (const auto& map : belief.map) numbers.push_back(number_of(*map));
  CHECK(numbers == std::vector<int>{102, 201, 201, 201});
}

TEST_CASE("the share of misses is of the measured pixels that the view has") {
  const auto frame = small_frame();
  CHECK(ppm::miss_share(*view_with_misses(*frame, {}), *frame) == 0);
  CHECK(ppm::miss_share(*view_with_misses(*frame, {1, 3}), *frame) == Approx(1.0 / 3));
  frame->depth.assign(4, std::numeric_limits<float>::quiet_NaN());
  CHECK(ppm::miss_share(*view_with_misses(*frame, {1}), *frame) == 0);
}
