#include <catch2/catch.hpp>
#include <set>

#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/prediction/view_groups.hpp"

using namespace ppm;

namespace {

using Views = std::vector<ViewPredictor::ExpectedView>;

Pose at(double x, double degrees = 0) {
  Pose pose = Pose::Identity();
  pose.translation().x() = x;
  pose.linear() = Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return pose;
}

const GroupLimits kLimits{0.1, 3 * EIGEN_PI / 180, 3};
const PpmMap kMap{PpmSettings{}}, kOther{PpmSettings{}};

}  // namespace

TEST_CASE("view groups: views close together make one, about their mean") {
  Views views;
  for (double x : {0.0, 0.02, 0.04, 0.06}) views.push_back({&kMap, at(x, 10 * x)});
  const auto groups = group_views(views, kLimits);
  REQUIRE(groups.size() == 1);
  CHECK(groups[0].members == std::vector<std::size_t>{0, 1, 2, 3});
  CHECK(groups[0].pose.translation().x() == Approx(0.03));
  CHECK(groups[0].pose.isApprox(at(0.03, 0.3), 1e-9));
}

TEST_CASE("view groups: each map has its own, few views have none") {
  Views views;
  for (int i = 0; i < 5; ++i) views.push_back({i % 2 ? &kOther : &kMap, at(0.01 * i)});
  const auto groups = group_views(views, kLimits);
  REQUIRE(groups.size() == 1);
  CHECK(groups[0].members == std::vector<std::size_t>{0, 2, 4});
  CHECK(group_views({}, kLimits).empty());
}

TEST_CASE("view groups: distance and angle are kept to, also where the mean is nobody's place") {
  Views views;
  for (double x : {0.0, 1.0, 0.01, 1.01, 0.02, 1.02, 9.0}) views.push_back({&kMap, at(x)});
  views.push_back({&kMap, at(0.01, 20)});
  const auto groups = group_views(views, kLimits);
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].members == std::vector<std::size_t>{0, 2, 4});
  CHECK(groups[1].members == std::vector<std::size_t>{1, 3, 5});
}

TEST_CASE("view groups: of a cloud, all within the limits, nobody twice") {
  Views views;
  Rng rng(3, 0, 0, 0);
  for (int i = 0; i < 400; ++i) views.push_back({&kMap, at(0.2 * rng.normal(), 4 * rng.normal())});
  std::set<std::size_t> seen;
  for (const auto& group : group_views(views, kLimits)) {
    CHECK(group.members.size() >= 3);
    CHECK(std::is_sorted(group.members.begin(), group.members.end()));
    for (auto i : group.members) {
      CHECK(seen.insert(i).second);
      const Pose off = group.pose.inverse() * views[i].T_map_camera;
      CHECK(off.translation().norm() <= kLimits.distance_m + 1e-9);
      CHECK(rotation_angle(off) <= kLimits.angle_rad + 1e-9);
    }
  }
  CHECK(seen.size() > 350);
}
