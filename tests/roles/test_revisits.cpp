#include <catch2/catch.hpp>

#include "framework/roles/revisits.hpp"

namespace {

using namespace ppm;

constexpr int kImages = 200;

/// A camera in front of a wall that goes away and comes back: image i sees what image 200 - i saw.
Pose camera_pose(std::int64_t i) {
  Pose T = Pose::Identity();
  T.translation().x() = 0.02 * static_cast<double>(std::min<std::int64_t>(i, kImages - i));
  return T;
}

class WallSequence final : public FrameSequence {
 public:
  std::string name() const override { return "wall"; }
  std::int64_t size() const override { return kImages; }
  double stamp_s(std::int64_t i) const override { return 0.1 * static_cast<double>(i); }
  std::optional<Pose> reference_pose(std::int64_t) const override { return std::nullopt; }
  Frame read(std::int64_t index) const override {
    Frame f;
    f.index = index;
    f.stamp_s = stamp_s(index);
    f.camera = {48, 36, 60, 60, 23.5, 17.5};
    f.depth.assign(48 * 36, 2.0f);
    return f;
  }
};

class WallSource final : public FrameSource {
 public:
  WallSource() { open_for_evaluation(); }

 private:
  std::unique_ptr<const FrameSequence> open_sequence() const override { return std::make_unique<WallSequence>(); }
};

/// The true path, whose second half stands nearer to the wall by `drift`.
std::vector<StampedPose> path(double drift) {
  std::vector<StampedPose> poses;
  for (int i = 0; i < kImages; ++i) {
    Pose T = camera_pose(i);
    if (i >= kImages / 2) T.translation().z() += drift;
    poses.push_back({1000 + i, 0.1 * i + 4e-7, T});  // numbers of lines and rounded stamps, as from a file
  }
  return poses;
}

}  // namespace

TEST_CASE("drift between two visits is the error at revisits, and is not seen by neighbours") {
  const WallSource source;
  const Workers workers(2);
  const RevisitSettings revisits;
  CHECK(score_revisits(path(0), source, revisits, workers)->median_mm < 1e-6);
  const auto drifted = score_revisits(path(0.03), source, revisits, workers);
  REQUIRE(drifted);
  CHECK(drifted->median_mm == Approx(30).epsilon(0.01));
  CHECK(drifted->pairs > 20);
  CHECK(drifted->pairs <= revisits.pairs);
  const RevisitSettings neighbours{RevisitSettings::Gap::exactly, 5, 50};
  const auto near = score_revisits(path(0.03), source, neighbours, workers);
  REQUIRE(near);
  CHECK(near->pairs == 50);
  CHECK(near->median_mm < 1e-6);
}

TEST_CASE("without a second visit there is nothing to score") {
  const WallSource source;
  const Workers workers(1);
  auto first = path(0);
  first.resize(60);
  CHECK_FALSE(score_revisits(first, source, {}, workers));
  CHECK_FALSE(score_revisits({}, source, {}, workers));
  RevisitSettings far;
  far.gap = 195;  // images 0 and 195 are 10 cm apart: seen
  CHECK(score_revisits(path(0), source, far, workers));
  auto elsewhere = path(0);
  for (std::size_t i = 100; i < elsewhere.size(); ++i) elsewhere[i].T_map_camera.translation().x() += 50;
  CHECK_FALSE(score_revisits(elsewhere, source, {}, workers));
}

TEST_CASE("pairs are limited, and the score does not depend on the number of threads") {
  const WallSource source;
  RevisitSettings few;
  few.pairs = 7;
  const auto one = score_revisits(path(0.01), source, few, Workers(1));
  const auto four = score_revisits(path(0.01), source, few, Workers(4));
  REQUIRE(one);
  CHECK(one->pairs == 7);
  CHECK(one->median_mm == four->median_mm);
  CHECK(one->pixels == four->pixels);
}
