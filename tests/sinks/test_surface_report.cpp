#include <catch2/catch.hpp>
#include <cmath>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/face_grid.hpp"
#include "modules/maps/ppm/surface_report.hpp"
#include "tests/prediction/ray_oracle.hpp"
#include "tests/support/ppm_maps.hpp"

using namespace ppm;

namespace {

/// Two squares of 1 m^2, parallel to the image plane, of two faces each: one at 2 m, one `apart` behind it.
std::shared_ptr<const PpmMap> two_sheets(float apart) {
  PpmEdit edit(std::make_shared<const PpmMap>(PpmSettings{}));
  for (float z : {2.0f, 2.0f + apart}) {
    const auto a = edit.add_vertex({-0.5f, -0.5f, z}), b = edit.add_vertex({0.5f, -0.5f, z});
    const auto c = edit.add_vertex({0.5f, 0.5f, z}), d = edit.add_vertex({-0.5f, 0.5f, z});
    test::add_flat_face(edit, {a, c, b}, 1, 0, 1e-4f);
    test::add_flat_face(edit, {a, d, c}, 1, 0, 1e-4f);
  }
  return edit.commit();
}

const Camera kCamera{40, 40, 120, 120, 20, 20};
const std::vector<StampedPose> kPath{StampedPose{}};

}  // namespace

TEST_CASE("a sheet 3 cm behind another is a second layer, one 6 cm behind is another thing") {
  const auto near = report_surface(*two_sheets(0.03f), kCamera, kPath, 500, Rng(1, 0, 0, 0));
  CHECK(near.faces == 4);
  CHECK(near.area_m2 == Approx(2));
  CHECK(near.boundary_edges == 8);
  CHECK(near.boundary_edges_per_m2() == Approx(4));
  CHECK(near.non_manifold_edges == 0);
  CHECK(near.rays == 500);
  CHECK(near.second_layer_share() > 0.98);  // but for slanted rays that pass by the second sheet
  CHECK(report_surface(*two_sheets(0.06f), kCamera, kPath, 500, Rng(1, 0, 0, 0)).second_layers == 0);
  CHECK(report_surface(*two_sheets(0.03f), kCamera, {}, 500, Rng(1, 0, 0, 0)).rays == 0);
}

TEST_CASE("a sheet that faces away or stands across is no second layer") {
  PpmEdit edit(two_sheets(1));
  const auto a = edit.add_vertex({-0.5f, -0.5f, 2.03f}), b = edit.add_vertex({0.5f, -0.5f, 2.03f});
  const auto c = edit.add_vertex({0.5f, 0.5f, 2.03f});
  test::add_flat_face(edit, {a, b, c}, 1, 0, 1e-4f);  // seen from behind
  CHECK(report_surface(*edit.commit(), kCamera, kPath, 500, Rng(1, 0, 0, 0)).second_layers == 0);
}

TEST_CASE("rays through the grid of faces meet what brute force says") {
  PpmSettings settings;
  const auto map = test::height_field(12, 9, 0.11f, settings,
                                      [](float x, float y) { return 0.3f * std::sin(5 * x) * std::cos(4 * y); });
  const FaceGrid grid(*map, GENERATE(0.05, 0.1, 3.0));
  Rng rng(5, 0, 0, 0);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d origin(2 * rng.uniform() - 0.5, 2 * rng.uniform() - 0.5, 2 * rng.uniform() - 0.5);
    const Eigen::Vector3d direction = Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized();
    const auto found = grid.first_hit(origin, direction, 0.1, 1.5);
    double nearest = 1.5;
    for (const auto& h : test::all_hits(*map, origin, direction, true, 0))
      if (h.range > 0.1) nearest = std::min(nearest, h.range);
    CHECK(found.has_value() == (nearest < 1.5));
    if (!found) continue;
    CHECK(found->range == Approx(nearest).epsilon(1e-5));
    CHECK(found->normal.dot(map->table()[found->chunk].geometry->face_normal(found->face)) > 0.9999f);
    ++hits;
  }
  CHECK(hits > 100);
}
