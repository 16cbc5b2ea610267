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
std::vector<float> expected;  // of the views that were announced, what they show

/// Predicts the map's number plus the camera's x as range, everywhere.
struct ToyView final : ppm::ViewPredictor {
  ToyView() : ViewPredictor("map.number") {}
  void prepare(const std::vector<const ppm::Map*>& maps, const ppm::Workers&) override {
    for (const auto* map : maps) prepared.push_back(number_of(*map));
  }
  void expect(const ppm::Camera& camera, const std::vector<ExpectedView>& all) override {
    CHECK(camera == frame->camera.decimated(frame->camera.cols == 8 ? 2 : 1));
    expected.clear();
    for (const auto& view : all)
      expected.push_back(static_cast<float>(number_of(*view.map) + view.T_map_camera.translation().x()));
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

/// A view that knows only how far to go: the rest is found on demand.
struct ToyDeferred final : ppm::DeferredView {
  std::vector<float> range;
  void sample(const ppm::Prediction&, std::span<const std::uint32_t> pixels, ppm::ViewSamples& out) const override {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      out.range[i] = range[pixels[i]];
      out.variance[i] = 1e-4f;
      out.cosine[i] = 0.5f;
    }
  }
  void fill(const ppm::Prediction& view, const ppm::Rows& rows, ppm::Prediction& out) const override {
    const auto cols = static_cast<std::size_t>(view.camera.cols);
    for (auto p = static_cast<std::size_t>(rows.first) * cols; p < static_cast<std::size_t>(rows.end) * cols; ++p) {
      out.range[p] = range[p];
      out.face[p] = 7;
    }
  }
};

struct ToyDeferring final : ppm::ViewPredictor {
  ToyDeferring() : ViewPredictor("map.number") {}
  void prepare(const std::vector<const ppm::Map*>&, const ppm::Workers&) override {}
  std::shared_ptr<ppm::DeferredView> defer(const ppm::Map&, const ppm::Prediction& out) const override {
    auto view = std::make_shared<ToyDeferred>();
    view->range.resize(static_cast<std::size_t>(out.camera.pixels()));
    return view;
  }
  void predict(const ppm::Map& map, const ppm::Rows& rows, ppm::Prediction& out, int) const override {
    auto& range = static_cast<ToyDeferred&>(*out.deferred).range;
    for (int i = rows.first * out.camera.cols; i < rows.end * out.camera.cols; ++i)
      range[static_cast<std::size_t>(i)] = static_cast<float>(number_of(map) + i);
  }
};

const ppm::Registry& toys() {
  static const ppm::Registry registry = [] {
    ppm::Registry r;
    r.add<ToyView>("prediction.toy", "Predicts numbers.", "made up");
    r.add<ToyDeferring>("prediction.deferring", "Predicts numbers on demand.", "made up");
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
    CHECK(expected == std::vector<float>{10, 20, 10.5});
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

TEST_CASE("a deferred view answers for chosen pixels, is completed from a pool, and predict_all() fills the arrays") {
  for (std::size_t particles : {1u, 40u}) {
    ppm::Harness h(toys(), "prediction.deferring", "{stride: 2}", 4);
    h.input<ppm::Frame>("frame", frame_of(6, 74));
    auto& belief = h.belief();
    belief.init(particles, shifted(0), number_map(10));
    for (std::size_t i = 0; i < particles; ++i) belief.pose[i] = shifted(static_cast<double>(i));
    h.tick();
    const auto& view = belief.prediction.back();
    REQUIRE(view->deferred);
    CHECK(view->range.empty());
    ppm::ViewSamples samples;
    const std::vector<std::uint32_t> pixels{3, 50, 110};
    samples.resize(pixels.size());
    view->sample(pixels, samples);
    CHECK(samples.range == std::vector<float>{13, 60, 120});

    ppm::PredictionPool pool;
    const ppm::Workers workers(3);
    const auto whole = completed(view, pool, workers);
    CHECK_FALSE(whole->deferred);
    CHECK(whole->camera == view->camera);
    CHECK(whole->stride == 2);
    CHECK(whole->range.size() == 3 * 37);
    CHECK(whole->range.back() == 10 + 3 * 37 - 1);
    CHECK(whole->face == std::vector<std::uint32_t>(3 * 37, 7));
    CHECK(completed(whole, pool, workers) == whole);
    for (const auto& either : {view, whole}) {
      std::vector<std::uint32_t> chunk(6), face(6);
      either->elements({1, 3}, chunk, face);
      CHECK(chunk == std::vector<std::uint32_t>(6, ppm::Prediction::kNone));
      CHECK(face == std::vector<std::uint32_t>(6, 7));
    }

    ppm::RecordWriter saved;
    saved.add(*view);
    ppm::RecordWriter saved_whole;
    saved_whole.add(*whole);
    CHECK(saved.bytes() == saved_whole.bytes());
  }
  ToyDeferring predictor;
  ppm::Prediction out;
  out.reset({3, 2, 1, 1, 1, 1}, 1, shifted(0));
  predictor.predict_all(*number_map(5), out, 0);
  CHECK_FALSE(out.deferred);
  CHECK(out.range == std::vector<float>{5, 6, 7, 8, 9, 10});
}
