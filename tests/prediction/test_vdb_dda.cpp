#include <catch2/catch.hpp>
#include <cmath>

#include "framework/config/config.hpp"
#include "framework/core/error.hpp"
#include "framework/core/se3.hpp"
#include "framework/graph/graph.hpp"
#include "framework/graph/harness.hpp"
#include "framework/slam/frame.hpp"
#include "modules/builtin.hpp"
#include "modules/prediction/vdb_view.hpp"
#include "tests/prediction/whole_views.hpp"
#include "tests/support/voxel_map.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

const Camera kCamera{50, 38, 40, -40, 24.5, 18.5};
const Eigen::Vector3d kLow(-1.03, -0.87, -0.95), kHigh(1.21, 0.98, 1.52);

std::shared_ptr<const VdbMap> box_map(double voxel_m) {
  const Eigen::Vector3d wall = Eigen::Vector3d::Constant(0.2);
  return voxel_map({voxel_m, -4, 6}, kLow - wall, kHigh + wall,
                   [&](const Eigen::Vector3d& p) { return surface_log_odds(box_distance(p, kLow, kHigh), 2 / voxel_m, 0.15); });
}

std::vector<PredictionHandle> views(const std::string& params, const std::shared_ptr<const Map>& map, std::size_t n,
                                    int threads = 1) {
  Registry registry;
  register_builtin(registry);
  Harness h(registry, "prediction.vdb_dda", params, threads);
  auto frame = std::make_shared<Frame>();
  frame->camera = kCamera;
  h.input<Frame>("frame", frame);
  h.belief().init(n, Pose::Identity(), map);
  for (std::size_t i = 0; i < n; ++i) {
    const double k = static_cast<double>(i);
    h.belief().pose[i] = se3_exp((Twist() << 0.02 * k, 0.003, 0.02, 0.2 * k, 0.1, 0.3 * k).finished());
  }
  h.tick();
  return whole_views(h.belief());
}

// Range along a ray from within the box.
double box_range(const Eigen::Vector3d& eye, const Eigen::Vector3d& way) {
  double range = 1e9;
  for (int a = 0; a < 3; ++a) range = std::min(range, ((way[a] > 0 ? kHigh : kLow)[a] - eye[a]) / way[a]);
  return range;
}

}  // namespace

TEST_CASE("prediction.vdb_dda sees a box from within where it is, its walls' normals and its tiles") {
  for (double voxel : {0.05, 0.02}) {
    const auto map = box_map(voxel);
    for (const auto& view : views("{}", map, 4)) {
      std::size_t off = 0, turned = 0;
      for (std::size_t p = 0; p < view->range.size(); ++p) {
        REQUIRE(view->hit(p));
        const Eigen::Vector3d way = view->direction(p), eye = view->T_map_camera.translation();
        const double truth = box_range(eye, way);
        off += std::abs(view->range[p] - truth) > 0.15 * voxel;  // near the box's edges the field is no plane's
        const Eigen::Vector3d q = eye + truth * way;
        const Eigen::Vector3d inwards = (q - kLow).cwiseMin(kHigh - q);
        int axis;
        inwards.minCoeff(&axis);
        turned += std::abs(view->normal[3 * p + static_cast<std::size_t>(axis)]) < 0.98;
        const Eigen::Map<const Eigen::Vector3f> normal(&view->normal[3 * p]);
        CHECK(normal.cast<double>().dot(way) < 0);
        CHECK(view->variance[p] > 0);
        CHECK(view->mean[p] == 0);
        REQUIRE(view->chunk[p] < map->table().size());
        const Cell cell = VdbMap::cell_of(map->voxel_of(eye + view->range[p] * way));
        CHECK((map->table().cell(view->chunk[p]) - cell).cwiseAbs().maxCoeff() <= 1);
        CHECK(view->face[p] < kVdbTileLeaves * kVdbLeafVoxels);
      }
      CHECK(off < 0.1 * static_cast<double>(view->range.size()));
      CHECK(turned < 0.15 * static_cast<double>(view->range.size()));
    }
  }
}

TEST_CASE("prediction.vdb_dda gives the same bytes whatever the threads") {
  const auto map = box_map(0.05);
  for (const std::string params : {"{}", "{surface: cell}", "{surface: expected, stride: 2}"}) {
    const auto one = views(params, map, 5, 1), three = views(params, map, 5, 3);
    for (std::size_t i = 0; i < one.size(); ++i) CHECK(bytes_of(*one[i]) == bytes_of(*three[i]));
  }
}

TEST_CASE("prediction.vdb_dda predicts some rows as it predicts them among all") {
  const auto map = box_map(0.05);
  const auto whole = views("{surface_sigma: 0}", map, 1)[0];
  Prediction bands;
  bands.reset(kCamera, 1, whole->T_map_camera);
  VdbView view;
  view.start(*map, {}, bands);
  for (Rows rows : {Rows{0, 7}, Rows{7, 8}, Rows{8, 38}}) view.fill(bands, rows, bands);
  CHECK(bytes_of(bands) == bytes_of(*whole));
}

TEST_CASE("no ray starts behind what it meets, near and far, with both signs of fy") {
  const auto map = voxel_map({0.05, -4, 6}, {-2, -2, -2}, {2, 2, 2}, [](const Eigen::Vector3d& p) {
    return std::sin(5 * p.x()) * std::sin(6 * p.y()) * std::sin(4 * p.z()) > 0.7 ? 3.0f : -3.0f;
  });
  std::size_t hits = 0;
  for (int i = 0; i < 12; ++i)
    for (double fy : {40.0, -40.0}) {
      Prediction view;
      const double k = i;
      view.reset({50, 38, 40, fy, 24.5, 18.5}, 1, se3_exp((Twist() << 0.2 * k, 0.1, -0.3 * k, 0.5 * k, 0.3, 0.7 * k).finished()));
      VdbView grid;
      grid.start(*map, {VoxelSurface::cell}, view);
      grid.fill(view, all_rows(view.camera), view);
      VoxelLeaves leaves(*map);
      std::size_t wrong = 0;
      for (std::size_t p = 0; p < view.range.size(); ++p) {
        VoxelRay ray = VoxelRay::make((view.T_map_camera.translation() / 0.05).cast<float>(), view.direction(p).cast<float>());
        const bool meets = ray.clip(Eigen::Array3f::Constant(-64), Eigen::Array3f::Constant(64));
        const VoxelHit whole = meets ? trace(ray, {VoxelSurface::cell}, leaves) : VoxelHit{};
        hits += whole.hit();
        // Where a ray cuts a voxel's very edge, rounding decides.
        wrong += whole.hit() != view.hit(p) || (whole.hit() && std::abs(whole.range * 0.05f - view.range[p]) > 1e-3f);
      }
      CHECK(wrong <= 5);
    }
  CHECK(hits > 5000);
}

TEST_CASE("an empty occupancy grid and one that is far away show nothing") {
  const auto empty = std::make_shared<const VdbMap>(VdbSettings{});
  const auto behind = voxel_map({0.05, -4, 6}, {-1, -1, -3}, {1, 1, -2}, [](const Eigen::Vector3d&) { return 2.0f; });
  for (const auto& map : {empty, behind}) {
    const auto view = views("{}", map, 1)[0];
    for (std::size_t p = 0; p < view->range.size(); ++p) CHECK_FALSE(view->hit(p));
  }
}

TEST_CASE("the cell form stops at the first cell's centre, nearer than the crossing by no more than a cell") {
  const auto map = box_map(0.05);
  const auto crossing = views("{}", map, 1)[0], cell = views("{surface: cell}", map, 1)[0];
  for (std::size_t p = 0; p < crossing->range.size(); ++p) {
    CHECK(std::abs(crossing->range[p] - cell->range[p]) < 2 * 0.05);
    CHECK(cell->range_variance(p, cell->direction(p)) == Approx(0.05 * 0.05 / 12).epsilon(1e-3));
  }
}

TEST_CASE("the surface's own deviation adds to that of the cells, in metres for any size of theirs") {
  const auto map = box_map(0.05);
  const auto without = views("{surface_sigma: 0, cell_sigma: 0.1}", map, 1)[0];
  const auto with = views("{surface_sigma: 2 cm, cell_sigma: 0.1}", map, 1)[0];
  for (std::size_t p = 0; p < with->range.size(); ++p) {
    CHECK(with->range[p] == without->range[p]);
    const auto ray = with->direction(p);
    CHECK(with->range_variance(p, ray) == Approx(without->range_variance(p, ray) + 4e-4).epsilon(1e-3));
  }
}

TEST_CASE("prediction.vdb_dda refuses a belief of meshes before the first frame, and parameters out of range") {
  Registry registry;
  register_builtin(registry);
  const std::string text = R"(name: mixed
nodes:
  - {name: camera, module: source.synthetic_room, params: {frames: 3}}
  - {name: init, module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}}
  - {name: look, module: prediction.vdb_dda, in: {frame: camera.frame}}
)";
  CHECK_THROWS_WITH(Graph::build(parse_yaml(text, "mixed.yaml"), registry),
                    Catch::Contains("node 'look' needs a 'vdb' map, but node 'init' gives 'ppm'"));
  for (const std::string wrong : {"{surface: nearest}", "{cell_sigma: -1}", "{normal_reach: 0}", "{voxels: 3}"})
    CHECK_THROWS_AS(Harness(registry, "prediction.vdb_dda", wrong), ConfigError);
}
