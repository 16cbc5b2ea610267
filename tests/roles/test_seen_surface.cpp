#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "framework/roles/seen_surface.hpp"

namespace {

using namespace ppm;

/// The plane z = 2.
class Wall final : public TrueSurface {
 public:
  void cast(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3f> direction,
            std::span<float> range_m) const override {
    for (std::size_t i = 0; i < direction.size(); ++i)
      range_m[i] = static_cast<float>((2 - origin.z()) / direction[i].z());
  }
  double distance(const Eigen::Vector3d& p) const override { return std::abs(p.z() - 2); }
};

/// Image i looks at the wall from (2 i, 0, 0) and sees 0.8 m by 0.6 m of it, one point a centimetre.
class WallSequence final : public FrameSequence {
 public:
  std::string name() const override { return "wall"; }
  std::int64_t size() const override { return 4; }
  double stamp_s(std::int64_t i) const override { return 0.1 * static_cast<double>(i); }
  std::optional<Pose> reference_pose(std::int64_t i) const override {
    if (i == 3) return std::nullopt;
    return Pose(Eigen::Translation3d(2 * static_cast<double>(i), 0, 0));
  }
  Frame read(std::int64_t index) const override {
    Frame f;
    f.index = index;
    f.stamp_s = stamp_s(index);
    f.camera = {80, 60, 200, 200, 39.5, 29.5};
    f.depth.assign(4800, 2.0f);
    return f;
  }
  std::unique_ptr<const TrueSurface> true_surface() const override { return std::make_unique<Wall>(); }
};

class WallSource final : public FrameSource {
 public:
  explicit WallSource(const std::string& text) {
    Diagnostics wrong;
    const auto values = parse_yaml(text, "test");
    params().parse(&values, "source.wall", {}, wrong);
    REQUIRE(wrong.empty());
    open_for_evaluation();
  }

 private:
  std::unique_ptr<const FrameSequence> open_sequence() const override { return std::make_unique<WallSequence>(); }
};

std::vector<Eigen::Vector3f> seen(const std::string& params, std::int64_t last = 100, int threads = 1) {
  const WallSource source(params);
  return seen_surface(*source.true_surface(), source, last, Workers(threads));
}

}  // namespace

TEST_CASE("what the mapped images see of a surface, a point a square centimetre") {
  const auto points = seen("{holdout: every 2nd}");  // 1 and 3 are held out
  CHECK(points.size() == Approx(2 * 4800).epsilon(0.1));
  std::set<std::pair<int, int>> cells;
  for (const auto& p : points) {
    CHECK(p.z() == Approx(2));
    CHECK(std::abs(p.y()) < 0.301f);
    CHECK((std::abs(p.x()) < 0.401f || std::abs(p.x() - 4) < 0.401f));
    cells.insert({int(std::floor(p.x() / 0.01f)), int(std::floor(p.y() / 0.01f))});
  }
  CHECK(cells.size() == points.size());
}

TEST_CASE("images behind the last, those without a reference pose and what is out of range are not seen") {
  const auto all = seen("{}").size();
  CHECK(all == Approx(3 * 4800).epsilon(0.1));
  CHECK(seen("{}", 1).size() == Approx(2 * 4800).epsilon(0.1));
  CHECK(seen("{first: 3}").empty());
  CHECK(seen("{max_range: 1.9}").empty());
  CHECK(seen("{min_range: 2.1}").empty());
  CHECK(seen("{}", 100, 4) == seen("{}"));
}
