#include <catch2/catch.hpp>
#include <numbers>
#include <set>

#include "framework/graph/harness.hpp"
#include "tests/map_update/box_world.hpp"
#include "tests/map_update/mapper.hpp"
#include "tests/support/registry.hpp"
#include "tests/support/workers.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr double kSigma = 0.004;

/// One particle that maps a box world through map_update.ppm_bayes.
class Run {
 public:
  explicit Run(const std::string& params, int threads = 1, std::size_t particles = 1)
      : harness_(builtin(), "map_update.ppm_bayes", params, threads) {
    harness_.belief().init(particles, look({0, 0, 0}), std::make_shared<const PpmMap>(PpmSettings{}));
  }
  MapHandle map(std::size_t particle = 0) { return harness_.belief().map[particle]; }

  /// The next frame, seen from there; further particles stand beside the first.
  void step(const Pose& pose, int stride = 1, bool held_out = false) {
    const auto index = frames_++;
    Frame frame = scene_.frame(small_camera(), pose, kSigma, index, true);
    frame.held_out = held_out;
    harness_.input<Frame>("frame", std::make_shared<const Frame>(std::move(frame)));
    auto& belief = harness_.belief();
    for (std::size_t k = 0; k < belief.size(); ++k) {
      belief.pose[k] = pose * Eigen::Translation3d(0.001 * static_cast<double>(k), 0, 0);
      Mapper view(std::static_pointer_cast<const PpmMap>(belief.map[k]));
      belief.prediction[k] = std::make_shared<const Prediction>(view.predict(small_camera(), belief.pose[k], stride));
    }
    harness_.tick();
  }
  ParticleSet& belief() { return harness_.belief(); }
  Harness& harness() { return harness_; }
  std::string digest() {
    Digest digest;
    for (const auto& map : harness_.belief().map) map->digest(digest);
    return digest.hex();
  }

 private:
  BoxWorld scene_;
  Harness harness_;
  std::uint32_t frames_ = 0;
};

const PpmMap& mesh(const MapHandle& map) {
  return static_cast<const PpmMap&>(*map);
}

/// Chunks whose geometry, whose texels two maps share.
std::pair<std::size_t, std::size_t> shared(const MapHandle& a, const MapHandle& b) {
  std::size_t geometry = 0, texels = 0;
  for (std::size_t c = 0; c < mesh(a).table().size(); ++c) {
    geometry += mesh(a).table()[c].geometry == mesh(b).table()[c].geometry;
    texels += mesh(a).table()[c].texels == mesh(b).table()[c].texels;
  }
  return {geometry, texels};
}

}  // namespace

TEST_CASE("between keyframes nothing hands the map back as it is") {
  Run run("{keyframe_every: 3, between: nothing}");
  run.step(look({0, 0, 0}));
  for (int round = 0; round < 2; ++round) {
    const auto map = run.map();
    run.step(look({0, 0, 0}));
    run.step(look({0, 0, 0}));
    CHECK(run.map() == map);
    run.step(look({0, 0, 0}));
    CHECK(run.map() != map);
  }
}

TEST_CASE("between keyframes texels take offsets: the variance falls in view, and all else is shared") {
  Run run("{keyframe_every: 100}");
  run.step(look({0, 0, 0}));
  run.step(look({0.02, 0, 0}, 0.03));
  const auto before = run.map();
  const auto stats = before->stats();
  run.step(look({0.02, 0, 0}, 0.03));
  const auto after = run.map();
  mesh(after).check();
  const std::size_t chunks = mesh(after).table().size();
  REQUIRE(chunks == mesh(before).table().size());
  CHECK(shared(before, after).first == chunks);
  CHECK(shared(before, after).second < chunks);
  CHECK(after->stats().faces == stats.faces);
  std::size_t texels = 0, fell = 0, rose = 0;
  for (std::size_t c = 0; c < chunks; ++c) {
    const Texels &a = *mesh(before).table()[c].texels, &b = *mesh(after).table()[c].texels;
    for (std::size_t t = 0; t < a.size(); ++t, ++texels) {
      fell += b.variance[t] < a.variance[t];
      rose += b.variance[t] > a.variance[t];
    }
    for (std::size_t f = 0; f < a.evidence.size(); ++f) CHECK(a.evidence[f].hits == b.evidence[f].hits);
  }
  CHECK(fell > texels / 2);
  CHECK(rose == 0);
}

TEST_CASE("texels read the same offsets between keyframes as in one, where the map explains the image") {
  Run light("{keyframe_every: 2, excess: none}"), full("{excess: none}");
  for (Run* run : {&light, &full}) {
    run->step(look({0, 0, 0}));
    run->step(look({0, 0, 0}));
  }
  // Faces of the first image keep their place at the front of each chunk, so that their texels can be compared.
  const auto &a = mesh(light.map()), &b = mesh(full.map());
  std::size_t same = 0, texels = 0;
  for (std::size_t c = 0; c < a.table().size(); ++c)
    for (std::size_t t = 0; t < a.table()[c].texels->size(); ++t, ++texels)
      same += t < b.table()[c].texels->size() && a.table()[c].texels->mean[t] == b.table()[c].texels->mean[t];
  CHECK(same > texels * 9 / 10);
}

TEST_CASE("a frame that teaches the map nothing, held out or while lost, does not take a keyframe's turn") {
  const bool held_out = GENERATE(true, false);
  CAPTURE(held_out);
  Run run("{keyframe_every: 3, between: nothing}");
  auto changes = [&](bool teaches) {
    const auto before = run.map();
    run.belief().lost = !teaches && !held_out;
    run.step(look({0, 0, 0}), 1, !teaches && held_out);
    return run.map() != before;
  };
  CHECK(changes(true));
  CHECK_FALSE(changes(false));
  CHECK_FALSE(changes(true));
  CHECK_FALSE(changes(true));
  CHECK_FALSE(changes(false));  // the third after the first
  CHECK(changes(true));

  const auto state = run.harness().save();
  run.harness().load(state, 6);  // the count is part of it
  CHECK_FALSE(changes(true));
  CHECK_FALSE(changes(true));
  CHECK(changes(true));
}

TEST_CASE("a frame in which the map shows nothing at many measured pixels is a keyframe") {
  const double misses = GENERATE(0.3, 1.0);
  CAPTURE(misses);
  Run run(fmt::format("{{keyframe_every: 100, between: nothing, keyframe_misses: {}, keyframe_angle: 180 deg}}", misses));
  run.step(look({0, 0, 0}));
  const auto map = run.map();
  run.step(look({0, 0, 0}, 0.1));
  CHECK(run.map() == map);
  run.step(look({0, 0, 0}, 0.9));  // half of it unseen
  CHECK((run.map() != map) == (misses < 1));
}

TEST_CASE("a frame far from the last keyframe, or turned from it, is one") {
  Run run("{keyframe_every: 100, between: nothing, keyframe_misses: 1, keyframe_distance: 10 cm, keyframe_angle: 10 deg}");
  auto changes = [&](const Pose& pose) {
    const auto before = run.map();
    run.step(pose);
    return run.map() != before;
  };
  const double degree = std::numbers::pi / 180;
  CHECK(changes(look({0, 0, 0})));
  CHECK_FALSE(changes(look({0.06, 0, 0})));
  CHECK(changes(look({0.12, 0, 0})));
  CHECK_FALSE(changes(look({0.18, 0, 0})));  // from the new one
  CHECK_FALSE(changes(look({0.18, 0, 0}, 8 * degree)));
  CHECK(changes(look({0.18, 0, 0}, 12 * degree)));
  CHECK_FALSE(changes(look({0.18, 0, 0}, 12 * degree)));
}

TEST_CASE("keyframes and frames between them give the same bytes for any number of threads, with strided views too") {
  const int stride = GENERATE(1, 2);
  std::set<std::string> digests;
  for (int threads : {1, 2, 4}) {
    Run run("{keyframe_every: 3, keyframe_misses: 0.2}", threads, 5);
    for (int i = 0; i < 7; ++i) run.step(look({0, 0, 0}, 0.05 * i), stride);
    for (std::size_t k = 0; k < 5; ++k) mesh(run.map(k)).check();
    digests.insert(run.digest());
  }
  CHECK(digests.size() == 1);
}
