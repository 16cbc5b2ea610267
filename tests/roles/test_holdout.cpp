#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/rng.hpp"
#include "framework/roles/holdout.hpp"

namespace {

using namespace ppm;

/// A plane normal . p = offset; the camera looks at it from below offset.
struct Plane {
  Eigen::Vector3d normal{0, 0, 1};
  double offset = 3;
  double range(const Pose& T_plane_camera, const Eigen::Vector3d& ray) const {
    const Eigen::Vector3d direction = (T_plane_camera.linear() * ray).normalized();
    return (offset - normal.dot(T_plane_camera.translation())) / normal.dot(direction);
  }
  /// The same plane in another frame.
  Plane moved(const Pose& T) const {
    const Eigen::Vector3d n = T.linear() * normal;
    return {n, offset + n.dot(T.translation())};
  }
};

struct PlaneMap final : Map {
  explicit PlaneMap(Plane p) : plane(p) {}
  std::string_view kind() const override { return "plane"; }
  MapStats stats() const override { return {}; }
  std::int64_t account(std::unordered_set<const void*>&) const override { return 0; }
  void digest(Digest&) const override {}
  Mesh mesh(Surface) const override { return {}; }
  Plane plane;
};

struct PlanePredictor final : ViewPredictor {
  PlanePredictor() : ViewPredictor("map.plane") {}
  void prepare(const std::vector<const Map*>& maps, const Workers&) override { prepared += maps.size(); }
  void predict(const Map& map, const Rows& rows, Prediction& out, int) const override {
    const auto& plane = static_cast<const PlaneMap&>(map).plane;
    for (int y = rows.first; y < rows.end; ++y)
      for (int x = 0; x < out.camera.cols; ++x) {
        const auto i = static_cast<std::size_t>(y * out.camera.cols + x);
        out.range[i] = static_cast<float>(plane.range(out.T_map_camera, out.camera.ray(x, y)));
        out.variance[i] = 1e-6f;
        out.chunk[i] = 0;
        const Eigen::Vector3f towards = -plane.normal.cast<float>();
        for (std::size_t k = 0; k < 3; ++k) out.normal[3 * i + k] = towards[static_cast<Eigen::Index>(k)];
      }
  }
  std::size_t prepared = 0;
};

/// A camera that turns while it sways in front of the plane.
Pose camera_pose(std::int64_t index) {
  const double t = 0.1 * static_cast<double>(index);
  Twist xi;
  xi << 0.3 * std::sin(t), 0.2 * std::cos(2 * t), 0.1 * t, 0.1 * std::sin(t), 0.15 * std::cos(t), 0.3 * t;
  return se3_exp(xi);
}

class PlaneSequence final : public FrameSequence {
 public:
  explicit PlaneSequence(bool poses) : poses_(poses) {}
  std::string name() const override { return "plane"; }
  std::int64_t size() const override { return 40; }
  double stamp_s(std::int64_t i) const override { return 0.1 * static_cast<double>(i); }
  std::optional<Pose> reference_pose(std::int64_t i) const override {
    return poses_ ? std::optional(camera_pose(i)) : std::nullopt;
  }
  Frame read(std::int64_t index) const override {
    Frame f;
    f.index = index;
    f.stamp_s = stamp_s(index);
    f.camera = {64, 48, 60, 60, 31.5, 23.5};
    f.depth.resize(static_cast<std::size_t>(f.camera.pixels()));
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x) {
        const auto ray = f.camera.ray(x, y);
        f.depth[static_cast<std::size_t>(64 * y + x)] =
            static_cast<float>(Plane{}.range(camera_pose(index), ray) / ray.norm());
      }
    return f;
  }

 private:
  bool poses_;
};

class PlaneSource final : public FrameSource {
 public:
  explicit PlaneSource(bool poses = true) : poses_(poses) {
    Diagnostics wrong;
    const auto values = parse_yaml("{holdout: every 5th}", "test");
    params().parse(&values, "source.plane", {}, wrong);
    REQUIRE(wrong.empty());
    open_for_evaluation();
  }

 private:
  std::unique_ptr<const FrameSequence> open_sequence() const override {
    return std::make_unique<PlaneSequence>(poses_);
  }
  bool poses_;
};

std::vector<StampedPose> moved(std::vector<StampedPose> path, const Pose& T) {
  for (auto& p : path) p.T_map_camera = T * p.T_map_camera;
  return path;
}

Pose some_motion() {
  Twist xi;
  xi << 4, -2, 1, 0.5, 2, -1;
  return se3_exp(xi);
}

constexpr std::int64_t kAll = 1000;

}  // namespace

TEST_CASE("a map in the reference's frame is looked at from the reference poses") {
  const PlaneSource source;
  PlanePredictor predictor;
  const auto poses = reference_poses(source.reference(), source.reference());
  CHECK(poses.name == "reference");
  const auto result = score_holdout(PlaneMap({}), source, {}, kAll, predictor, poses, Workers(2));
  REQUIRE(result);
  CHECK(predictor.prepared == 1);
  CHECK(result->frames == 8);
  CHECK(result->score.pixels == 8 * 8 * 6);
  CHECK(result->score.coverage == 1);
  CHECK(result->score.median_mm < 0.01);
  CHECK(result->score.within_1cm == 1);
}

TEST_CASE("a path written as text and read again is still the reference") {
  const PlaneSource source;
  auto path = source.reference();
  for (auto& p : path) {
    p.stamp_s += 4e-7;
    p.T_map_camera.translation().array() += 5e-10;
  }
  CHECK(reference_poses(path, source.reference()).name == "reference");
  path[3].T_map_camera.translation().x() += 1e-3;
  CHECK(reference_poses(path, source.reference()).name == "reference, aligned");
}

TEST_CASE("a map in a frame of its own is looked at from aligned poses") {
  const PlaneSource source;
  PlanePredictor predictor;
  const Pose T = some_motion();
  auto path = moved(source.reference(), T);
  const PlaneMap map(Plane{}.moved(T));
  SECTION("whole path") {}
  SECTION("one frame is enough") {
    path.resize(1);
  }
  SECTION("frames without a reference do not count") {
    path.push_back({999, 99.0, Pose::Identity()});
  }
  const auto poses = reference_poses(path, source.reference());
  CHECK(poses.name == "reference, aligned");
  const auto result = score_holdout(map, source, {}, kAll, predictor, poses, Workers(1));
  REQUIRE(result);
  CHECK(result->poses == "reference, aligned");
  CHECK(result->frames == 8);
  CHECK(result->score.median_mm < 0.01);
}

TEST_CASE("noise of the path averages out of the alignment, on a straight line too") {
  std::vector<StampedPose> reference, path;
  const Pose T = some_motion();
  Rng rng(5, 0, 0, 0);
  for (int i = 0; i < 400; ++i) {
    Pose pose = Pose::Identity();
    pose.translation().x() = 0.01 * i;  // positions alone leave the turn about x open
    reference.push_back({i, 0.1 * i, pose});
    Twist noise;
    for (int k = 0; k < 6; ++k) noise[k] = 0.02 * rng.normal();
    path.push_back({i, 0.1 * i, T * pose * se3_exp(noise)});
  }
  Frame frame;
  frame.T_world_camera_ref = Pose::Identity();
  const auto found = reference_poses(path, reference).T_map_camera(frame);
  REQUIRE(found);
  CHECK(rotation_angle(T.inverse() * *found) < 0.005);
  CHECK((T.inverse() * *found).translation().norm() < 0.015);
}

TEST_CASE("estimated poses are interpolated between neighbours, and not beyond the ends") {
  std::vector<StampedPose> path;
  for (int i : {1, 2, 4}) {
    Pose pose = Pose::Identity();
    pose.translation().x() = i;
    pose.rotate(Eigen::AngleAxisd(0.2 * i, Eigen::Vector3d::UnitZ()));
    path.push_back({i, double(i), pose});
  }
  const auto poses = estimated_poses(path, false);
  CHECK(poses.name == "estimated, between neighbours");
  auto at = [&](double stamp) {
    Frame f;
    f.stamp_s = stamp;
    return poses.T_map_camera(f);
  };
  CHECK_FALSE(at(0.9));
  CHECK_FALSE(at(4.1));
  CHECK(at(1)->translation().x() == 1);
  CHECK(at(1 + 4e-7)->translation().x() == 1);
  CHECK(at(4)->translation().x() == 4);
  CHECK(at(3.5)->translation().x() == Approx(3.5));
  CHECK(rotation_angle(*at(3.5)) == Approx(0.7));
  CHECK_FALSE(estimated_poses({}, false).T_map_camera(Frame{}));
}

TEST_CASE("estimated poses of frames that were followed are the path's own, and no others") {
  std::vector<StampedPose> path;
  for (int i : {1, 2, 4}) {
    Pose pose = Pose::Identity();
    pose.translation().x() = i;
    path.push_back({i, 0.1 * i - 4e-7, pose});  // rounded, as from a file
  }
  const auto poses = estimated_poses(path, true);
  CHECK(poses.name == "estimated");
  auto at = [&](double stamp) {
    Frame f;
    f.stamp_s = stamp;
    return poses.T_map_camera(f);
  };
  for (int i : {1, 2, 4}) CHECK(at(0.1 * i)->translation().x() == i);
  CHECK_FALSE(at(0.3));
  CHECK_FALSE(at(0.5));
}

TEST_CASE("only frames up to the last mapped one are scored, and only those with a pose") {
  const PlaneSource source;
  PlanePredictor predictor;
  const auto poses = reference_poses(source.reference(), source.reference());
  CHECK(score_holdout(PlaneMap({}), source, {}, 11, predictor, poses, Workers(1))->frames == 2);  // 2 and 7
  CHECK_FALSE(score_holdout(PlaneMap({}), source, {}, 1, predictor, poses, Workers(1)));

  const auto some = estimated_poses({source.reference()[5], source.reference()[9]}, false);  // frames 6 and 11
  CHECK(score_holdout(PlaneMap({}), source, {}, kAll, predictor, some, Workers(1))->frames == 1);

  const PlaneSource without(false);
  CHECK(without.reference().empty());
  CHECK_FALSE(score_holdout(PlaneMap({}), without, {}, kAll, predictor, poses, Workers(1)));
  CHECK_THROWS_AS(reference_poses(source.reference(), without.reference()), DataError);
}

TEST_CASE("each held-out frame has a score of its own") {
  const PlaneSource source;
  PlanePredictor predictor;
  const auto poses = reference_poses(source.reference(), source.reference());
  const auto result = score_holdout(PlaneMap({{0, 0, 1}, 3.01}), source, {}, kAll, predictor, poses, Workers(2));
  REQUIRE(result->by_frame.size() == result->frames);
  std::size_t pixels = 0;
  double density = 0;
  for (std::size_t i = 0; i < result->by_frame.size(); ++i) {
    const auto& frame = result->by_frame[i];
    CHECK(frame.index == source.held_out()[i]);
    CHECK(frame.score.coverage == 1);
    CHECK(frame.score.median_mm > 1);
    pixels += frame.score.pixels;
    density += static_cast<double>(frame.score.pixels) * frame.score.log_density;
  }
  CHECK(pixels == result->score.pixels);
  CHECK(density / static_cast<double>(pixels) == Approx(result->score.log_density));
}

TEST_CASE("the score does not depend on the number of threads") {
  const PlaneSource source;
  PlanePredictor predictor;
  const auto poses = estimated_poses(source.reference(), false);
  const PlaneMap map({Eigen::Vector3d(0.01, 0, 1).normalized(), 3.01});
  const auto one = score_holdout(map, source, {}, kAll, predictor, poses, Workers(1));
  const auto four = score_holdout(map, source, {}, kAll, predictor, poses, Workers(4));
  CHECK(one->score.median_mm == four->score.median_mm);
  CHECK(one->score.log_density == four->score.log_density);
  CHECK(one->score.mean_trunc20cm_mm == four->score.mean_trunc20cm_mm);
  CHECK(one->score.median_mm > 1);
}

namespace {

/// Every depth is as good as the given sigma, to 1 % of it.
class SetSigma final : public SensorModel {
 public:
  explicit SetSigma(float sigma) : sigma_(sigma) {}
  void set_noise(Frame& image) const override { image.sigma.assign(image.depth.size(), sigma_); }

 private:
  float sigma_;
};

}  // namespace

TEST_CASE("the density of a held-out frame is that of the graph's sensor, errors are as measured") {
  const PlaneSource source;
  PlanePredictor predictor;
  const auto poses = reference_poses(source.reference(), source.reference());
  const PlaneMap map({{0, 0, 1}, 3.01});
  auto score = [&](const std::vector<const SensorModel*>& sensor) {
    return score_holdout(map, source, sensor, kAll, predictor, poses, Workers(2))->score;
  };
  const SetSigma coarse(1.0f), fine(0.01f);
  const auto own = score({}), blurred = score({&coarse}), last_wins = score({&coarse, &fine});
  CHECK(blurred.median_mm == own.median_mm);
  CHECK(blurred.log_density < -0.8);
  CHECK(last_wins.log_density > 2.5);
}
