#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "modules/prediction/voxel_ray.hpp"
#include "tests/support/voxel_map.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

constexpr double kSize = 0.05;  // m, of a voxel
const VdbSettings kSettings{kSize, -4, 4};

// Blobs of occupied voxels in space that is partly free and partly unknown, with noise: nothing smooth to rely on.
std::shared_ptr<const VdbMap> rubble(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-3.0, 1.0);
  return voxel_map(kSettings, {-1, -1, -1}, {1, 1, 1}, [&](const Eigen::Vector3d& p) -> std::optional<float> {
    const double draw = noise(random);
    if (std::sin(9 * p.x()) + std::sin(7 * p.y()) > 1.5) return std::nullopt;
    if (std::sin(5 * p.x()) * std::sin(6 * p.y()) * std::sin(4 * p.z()) > 0.3) return static_cast<float>(draw + 3);
    return draw > 0.98 ? 2.0f : static_cast<float>(std::min(draw, -0.5));
  });
}

VoxelRay random_ray(std::mt19937& random) {
  std::uniform_real_distribution<float> place(-30, 30), toward(-10, 10);
  const Eigen::Vector3f from(place(random), place(random), place(random));
  const Eigen::Vector3f to(toward(random), toward(random), toward(random));
  VoxelRay ray = VoxelRay::make(from, (to - from).normalized());
  return ray;
}

// The first occupied voxel by very small steps along the ray; the point where it was found.
std::optional<Eigen::Vector3d> first_occupied(const VdbMap& map, const VoxelRay& ray) {
  constexpr double kStep = 2e-3;
  for (double t = ray.from; t < ray.to; t += kStep) {
    const Eigen::Vector3d p = ray.origin.cast<double>() + t * ray.direction.cast<double>();
    const auto value = map.log_odds(p.array().floor().cast<int>().matrix());
    if (value && *value > 0) return p;
  }
  return std::nullopt;
}

const Eigen::Array3f kLow = Eigen::Array3f::Constant(-32), kHigh = Eigen::Array3f::Constant(32);

}  // namespace

TEST_CASE("a ray stops at the first occupied voxel, as very small steps do") {
  std::size_t hits = 0, misses = 0, corners = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto map = rubble(seed);
    VoxelLeaves leaves(*map);
    std::mt19937 random(seed);
    for (int i = 0; i < 300; ++i) {
      VoxelRay ray = random_ray(random);
      if (!ray.clip(kLow, kHigh)) continue;
      const VoxelHit hit = trace(ray, {VoxelSurface::cell}, leaves);
      const auto found = first_occupied(*map, ray);
      if (!found) {
        // Small steps may cut a corner that the walk visits, never the other way.
        corners += hit.hit();
        misses += !hit.hit();
        continue;
      }
      REQUIRE(hit.hit());
      const Cell voxel = found->array().floor().cast<int>();
      if (hit.voxel != voxel) {
        ++corners;
        continue;
      }
      ++hits;
      const Eigen::Vector3f centre = voxel.cast<float>() + Eigen::Vector3f::Constant(0.5f);
      CHECK(hit.range == Approx(std::max((centre - ray.origin).dot(ray.direction), 0.0f)).margin(1e-3));
      CHECK(hit.chunk == map->table().find(VdbMap::cell_of(voxel)));
    }
  }
  CHECK(hits > 300);
  CHECK(misses > 50);
  CHECK(corners < 10);
}

TEST_CASE("the crossing finds a plane between the voxels, from any side and at any slant") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int turn = 0; turn < 12; ++turn) {
    const Eigen::Vector3d n = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    const double offset = 0.3 * normal(random) * kSize;
    const auto map = voxel_map(kSettings, {-1, -1, -1}, {1, 1, 1}, [&](const Eigen::Vector3d& p) {
      return surface_log_odds(offset - n.dot(p), 60, 0.2);  // free on the side that n points to
    });
    VoxelLeaves leaves(*map);
    std::size_t hits = 0;
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d target = 0.2 * Eigen::Vector3d(normal(random), normal(random), normal(random));
      const Eigen::Vector3d on_plane = target - (n.dot(target) - offset) * n;
      const Eigen::Vector3d eye = on_plane + 0.6 * (n + 0.4 * Eigen::Vector3d(normal(random), normal(random), normal(random)));
      const Eigen::Vector3d way = (on_plane - eye).normalized();
      if (n.dot(eye) - offset < 0.15 || on_plane.cwiseAbs().maxCoeff() > 0.6) continue;
      VoxelRay ray = VoxelRay::make((eye / kSize).cast<float>(), way.cast<float>());
      REQUIRE(ray.clip(kLow, kHigh));
      const VoxelHit hit = trace(ray, {}, leaves);
      REQUIRE(hit.hit());
      ++hits;
      CHECK(hit.range * kSize == Approx((on_plane - eye).norm()).margin(0.02 * kSize));
      // Log odds rise by 60 |n . ray| a metre: a logistic distribution of that scale, and the cells' own.
      const double scale = 1 / (60 * kSize * std::abs(n.dot(way)));
      const double most = std::min(std::pow(M_PI, 2) / 3 * scale * scale, 1.0);
      CHECK(hit.variance == Approx(most + 0.04).epsilon(0.25));
      CHECK(normal_of(ray, hit, {}, leaves).dot(n.cast<float>()) > 0.995f);
    }
    CHECK(hits > 20);
  }
}

TEST_CASE("the expected surface is the posterior's mean over the cells, and its spread") {
  // Along x: free, then three cells of which each is occupied with some probability, then surely occupied.
  const std::vector<float> log_odds{-4, -4, -1, 0.5f, 1, 4, 4, 4, 4};
  const auto map = voxel_map(kSettings, {-0.5, -0.5, -0.5}, {1, 0.5, 0.5}, [&](const Eigen::Vector3d& p) -> std::optional<float> {
    const auto x = static_cast<int>(std::floor(p.x() / kSize));
    if (x < 0) return -4.0f;
    return x < static_cast<int>(log_odds.size()) ? log_odds[static_cast<std::size_t>(x)] : 4.0f;
  });
  VoxelLeaves leaves(*map);
  VoxelRay ray = VoxelRay::make({-8.0f, 0.5f, 0.5f}, {1, 0, 0});
  REQUIRE(ray.clip(kLow, kHigh));
  const VoxelHit hit = trace(ray, {VoxelSurface::expected, 0}, leaves);
  const VdbMap& grid = *map;
  double left = 1, mean = 0, square = 0;
  for (int x = 0; x < 7; ++x) {  // the walk begins three cells before the first above 0
    const double p = 1 / (1 + std::exp(-static_cast<double>(*grid.log_odds({x, 0, 0})))), here = left * p;
    mean += here * (x + 0.5), square += here * (std::pow(x + 0.5, 2) + 1.0 / 12);
    left -= here;
  }
  mean /= 1 - left, square /= 1 - left;
  REQUIRE(hit.hit());
  CHECK(hit.range == Approx(8 + mean).margin(0.01));
  CHECK(hit.variance == Approx(square - mean * mean).margin(0.02));
}

TEST_CASE("rays through free or unknown space alone are misses, whichever way they go") {
  const auto free = voxel_map(kSettings, {-1, -1, -1}, {1, 1, 1}, [](const Eigen::Vector3d&) { return -2.0f; });
  const auto unknown = voxel_map(kSettings, {-1, -1, -1}, {1, 1, 1}, [](const Eigen::Vector3d&) { return std::nullopt; });
  std::mt19937 random(3);
  for (const auto& map : {free, unknown}) {
    VoxelLeaves leaves(*map);
    for (int i = 0; i < 200; ++i) {
      VoxelRay ray = random_ray(random);
      if (ray.clip(kLow, kHigh)) CHECK_FALSE(trace(ray, {}, leaves).hit());
    }
    for (int axis = 0; axis < 3; ++axis)
      for (float way : {-1.0f, 1.0f}) {
        VoxelRay ray = VoxelRay::make(Eigen::Vector3f(0, 16, -8), way * Eigen::Vector3f::Unit(axis));
        REQUIRE(ray.clip(kLow, kHigh));
        CHECK_FALSE(trace(ray, {}, leaves).hit());
      }
  }
}

TEST_CASE("a ray that starts in occupied space hits at once") {
  const auto solid = voxel_map(kSettings, {-1, -1, -1}, {1, 1, 1}, [](const Eigen::Vector3d&) { return 3.0f; });
  VoxelLeaves leaves(*solid);
  for (auto surface : {VoxelSurface::crossing, VoxelSurface::cell, VoxelSurface::expected}) {
    VoxelRay ray = VoxelRay::make({0.3f, 0.6f, 0.2f}, Eigen::Vector3f(1, 2, -1).normalized());
    REQUIRE(ray.clip(kLow, kHigh));
    const VoxelHit hit = trace(ray, {surface}, leaves);
    REQUIRE(hit.hit());
    CHECK(hit.range >= 0);
    CHECK(hit.range < 2);
    CHECK(normal_of(ray, hit, {}, leaves).isApprox(-ray.direction));
  }
}
