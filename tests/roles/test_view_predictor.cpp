#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>

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
  void predict(const ppm::Map& map, const ppm::Rows& rows, ppm::Prediction& out, int) const override {
    if (rows.first == 0) ++views;
    for (int y = rows.first; y < rows.end; ++y)
      for (int x = 0; x < out.camera.cols; ++x) {
        float& range = out.range[static_cast<std::size_t>(y * out.camera.cols + x)];
        const bool first_time = range == ppm::Prediction::kMiss;
        range = first_time ? static_cast<float>(number_of(map) + out.T_map_camera.translation().x()) : NAN;
      }
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

std::shared_ptr<const ppm::Frame> frame_of(int cols, int rows) {
  auto frame = std::make_shared<ppm::Frame>();
  frame->camera = {cols, rows, 4, 4, 3.5, 1.5};
  return frame;
}
std::shared_ptr<const ppm::Frame> frame_8x4() {
  return frame_of(8, 4);
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

TEST_CASE("a view is made in parts where there are few, whole where there are many, each pixel once") {
  for (std::size_t particles : {1u, 40u}) {
    ppm::Harness h(toys(), "prediction.toy", "{}", 4);
    h.input<ppm::Frame>("frame", frame_of(3, 37));
    auto& belief = h.belief();
    belief.init(particles, shifted(0), number_map(10));
    for (std::size_t i = 0; i < particles; ++i) belief.pose[i] = shifted(static_cast<double>(i));
    views = 0;
    h.tick();
    CHECK(views == static_cast<int>(particles));
    for (std::size_t i = 0; i < particles; ++i)
      CHECK(belief.prediction[i]->range == std::vector<float>(3 * 37, static_cast<float>(10 + i)));
  }
}
