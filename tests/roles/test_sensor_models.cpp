#include <catch2/catch.hpp>

#include "framework/roles/frame_filter.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/roles/map_editor.hpp"
#include "framework/roles/sensor_models.hpp"
#include "framework/roles/view_predictor.hpp"

namespace {

using namespace ppm;

class NoSource final : public Module {
 public:
  Out<Frame> frame{this, "frame", "Nothing."};
  void tick(Context&) override {}
};

template <int K>
class Model final : public SensorModel {
 public:
  void set_noise(Frame& image) const override { image.lateral_px = K; }
};

class Keep final : public Preprocessing {
 protected:
  void apply(Frame&, const Workers&) const override {}
};

class Init final : public Module {
 public:
  InOut<Belief> belief{this, {{}, {"belief", "map.toy"}, {}}};
  void tick(Context&) override {}
};

class Look final : public ViewPredictor {
 public:
  Look() : ViewPredictor("map.toy") {}
  void prepare(const std::vector<const Map*>&, const Workers&) override {}
  void predict(const Map&, const Rows&, Prediction&, int) const override {}
};

class Thin final : public MapEditor {
 public:
  Thin() : MapEditor({{"map.toy"}, {}, {}}) {}
  MapHandle edit(Context&, std::size_t, MapHandle map, int) override { return map; }
};

class Update final : public MapEditor {
 public:
  In<Frame> frame{this, "frame", "The image."};
  Update() : MapEditor({{"map.toy"}, {}, {}}) {}
  MapHandle edit(Context&, std::size_t, MapHandle map, int) override { return map; }
};

/// What the models that are found make of lateral_px, in order: "2 1".
std::string found(const std::string& nodes) {
  Registry r;
  r.add<NoSource>("source.none", "None.", "test");
  r.add<Model<1>>("sensor.one", "One.", "test");
  r.add<Model<2>>("sensor.two", "Two.", "test");
  r.add<Keep>("preprocess.keep", "Keeps.", "test");
  r.add<Init>("map.toy", "Starts.", "test");
  r.add<Look>("prediction.toy", "Looks.", "test");
  r.add<Thin>("simplify.toy", "Thins.", "test");
  r.add<Update>("map_update.toy", "Maps.", "test");
  const Graph graph = Graph::build(parse_yaml("name: g\nseed: 1\nnodes:\n" + nodes, "test"), r);
  std::string text;
  for (const auto* model : sensor_models(graph)) {
    Frame frame;
    model->set_noise(frame);
    text += (text.empty() ? "" : " ") + std::to_string(static_cast<int>(frame.lateral_px));
  }
  return text;
}

const std::string kStart = R"(
  - {name: camera, module: source.none}
  - {name: init, module: map.toy}
  - {name: thin, module: simplify.toy}
)";

}  // namespace

TEST_CASE("held-out frames get the models that a mapped frame has passed, and no other") {
  CHECK(found(kStart + R"(
  - {name: look, module: prediction.toy, in: {frame: camera.frame}}
  - {name: update, module: map_update.toy, in: {frame: camera.frame}}
  - {name: late, module: sensor.one, in: {frame: camera.frame}}
)")
            .empty());
  CHECK(found(kStart + R"(
  - {name: a, module: sensor.two, in: {frame: camera.frame}}
  - {name: keep, module: preprocess.keep, in: {frame: a.frame}}
  - {name: b, module: sensor.one, in: {frame: keep.frame}}
  - {name: beside, module: sensor.two, in: {frame: camera.frame}}
  - {name: look, module: prediction.toy, in: {frame: camera.frame}}
  - {name: update, module: map_update.toy, in: {frame: b.frame}}
)") == "2 1");
}

TEST_CASE("a graph that maps nothing has the model of what is looked at") {
  CHECK(found(kStart + R"(
  - {name: a, module: sensor.two, in: {frame: camera.frame}}
  - {name: look, module: prediction.toy, in: {frame: a.frame}}
)") == "2");
  CHECK(found(kStart).empty());
}
