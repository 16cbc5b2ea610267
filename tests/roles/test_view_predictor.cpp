#include <atomic>
#include <catch2/catch.hpp>

#include "framework/graph/harness.hpp"
#include "framework/roles/view_predictor.hpp"
#include "tests/roles/toy_maps.hpp"

namespace {

using namespace ppm::test;

std::atomic<int> views;
std::vector<int> prepared;

/// Predicts the map's number plus the camera's x as range, everywhere.
struct ToyView final : ppm::ViewPredictor {
  ToyView() : ViewPredictor("map.number") {}
  void prepare(const std::vector<const ppm::Map*>& maps, const ppm::Workers&) override {
    for (const auto* map : maps) prepared.push_back(number_of(*map));
  }
  void predict(const ppm::Map& map, ppm::Prediction& out, int) const override {
    ++views;
    for (auto& r : out.range) r = static_cast<float>(number_of(map) + out.T_map_camera.translation().x());
  }
};

const ppm::Registry& toys() {
  static const ppm::Registry registry = [] {
    ppm::Registry r;
    r.add<ToyView>("prediction.toy", "Predicts numbers.", "made up");
    return r;
  }();
  return registry;
}

std::shared_ptr<const ppm::Frame> frame_8x4() {
  auto frame = std::make_shared<ppm::Frame>();
  frame->camera = {8, 4, 4, 4, 3.5, 1.5};
  return frame;
}

}  // namespace

TEST_CASE("each particle gets its view, twins the same one, each map is prepared once") {
  for (int threads : {1, 4}) {
    ppm::Harness h(toys(), "prediction.toy", "{stride: 2}", threads);
    h.input<ppm::Frame>("frame", frame_8x4());
    auto& belief = h.belief();
    belief.init(5, shifted(0), number_map(10));
    belief.map[1] = belief.map[4] = number_map(20);
    belief.pose[2] = shifted(0.5);
    prepared.clear();
    views = 0;
    h.tick();
    CHECK(prepared == std::vector<int>{10, 20});
    CHECK(views == 3);
    CHECK(belief.prediction[0] == belief.prediction[3]);
    CHECK(belief.prediction[1] == belief.prediction[4]);
    const std::vector<float> ranges{10, 20, 10.5, 10, 20};
    for (std::size_t i = 0; i < 5; ++i) {
      const auto& p = *belief.prediction[i];
      CHECK(p.camera == frame_8x4()->camera.decimated(2));
      CHECK(p.stride == 2);
      CHECK(p.range == std::vector<float>(8, ranges[i]));
    }

    // The next frame's views are new, in memory that was given back.
    const auto kept = belief.prediction[2];
    belief.pose[2] = shifted(1);
    h.tick();
    CHECK(kept->range[0] == 10.5f);
    CHECK(belief.prediction[2]->range[0] == 11.0f);
  }
}
