#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "modules/maps/ppm/boundary.hpp"
#include "modules/maps/ppm/hole_fill.hpp"
#include "modules/maps/ppm/notch_fill.hpp"
#include "tests/map_update/views.hpp"
#include "tests/support/ppm_maps.hpp"
#include "tests/support/workers.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

/// Looks down at the middle of a 1 m x 1 m height field from 2 m above; the measurement is the field's plane unless
/// given.
struct Above {
  Frame frame;
  Prediction nothing;
  UpdateView view;
  explicit Above(float depth = 2.0f) : frame(frame_of([depth](int, int) { return depth; })) {
    Pose T = Pose::Identity();
    T.translate(Eigen::Vector3d(0.5, 0.5, 2));
    T.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
    nothing.reset(frame.camera, 1, T);
    view.build(frame, nothing, test::one_worker());
  }
};

PpmSettings cells(double size) {
  PpmSettings s;
  s.cell_size_m = size;
  return s;
}

std::size_t open_edges(const Boundary& boundary) {
  std::size_t n = 0;
  std::vector<std::uint32_t> ends;
  for (std::uint32_t v = 0; v < boundary.vertex.size(); ++v) {
    boundary.open_from(v, ends);
    n += ends.size();
  }
  return n;
}

/// Faces whose centroid is in [x0, x1] x [y0, y1].
std::vector<FaceRef> faces_in(const PpmMap& map, float x0, float y0, float x1, float y1) {
  std::vector<FaceRef> faces;
  for (std::uint32_t c = 0; c < map.table().size(); ++c)
    for (std::uint32_t f = 0; f < map.table()[c].geometry->face.size(); ++f) {
      const Eigen::Vector3f p = map.table()[c].geometry->point(f, 1.0f / 3, 1.0f / 3);
      if (p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1) faces.push_back({c, f});
    }
  return faces;
}

}  // namespace

TEST_CASE("a face between the rays of pixels is on the boundary too") {
  const Above above;
  const Eigen::Vector3f between = above.view.absolute(2.0f * above.view.ray(40.5f, 30.5f));
  PpmEdit edit(std::make_shared<const PpmMap>(cells(1)));
  const auto a = edit.add_vertex(between), b = edit.add_vertex(between + Eigen::Vector3f(1e-3f, 0, 0)),
             c = edit.add_vertex(between + Eigen::Vector3f(0, 1e-3f, 0));
  const std::vector<float> mean(3, 0.0f), variance(3, 1e-6f);
  edit.add_face({a, b, c}, 1, {mean, variance});
  Boundary boundary;
  boundary.build(*edit.commit(), above.view, {});
  CHECK(open_edges(boundary) == 3);
}

TEST_CASE("the boundary is the mesh's rim, whatever chunks it is cut into") {
  const Above above;
  for (double cell : {10.0, 0.3}) {
    const auto map = height_field(10, 10, 0.1f, cells(cell));
    Boundary boundary;
    boundary.build(*map, above.view, {});
    CHECK(open_edges(boundary) == 40);
  }
}

TEST_CASE("faces taken away open their edges, also across chunks") {
  const Above above;
  for (double cell : {10.0, 0.3}) {
    const auto map = height_field(10, 10, 0.1f, cells(cell));
    const auto hole = faces_in(*map, 0.4f, 0.4f, 0.6f, 0.6f);  // two by two squares
    REQUIRE(hole.size() == 8);
    Boundary boundary;
    boundary.build(*map, above.view, hole);
    CHECK(open_edges(boundary) == 48);
  }
}

TEST_CASE("the boundary refuses a third face at an edge and a face wound against its neighbour") {
  const Above above;
  const auto map = height_field(2, 2, 0.5f);
  Boundary boundary;
  boundary.build(*map, above.view, {});
  const auto number = [&](float x, float y) {
    for (std::uint32_t v = 0; v < boundary.vertex.size(); ++v)
      if (boundary.vertex[v].position.head<2>().isApprox(Eigen::Vector2f(x, y))) return v;
    FAIL("no vertex there");
    return 0u;
  };
  const auto a = number(0, 0), b = number(0.5f, 0);
  const auto tip = boundary.add_vertex(above.view, {0.25f, -0.9f, 0}, Eigen::Vector3f::UnitZ());
  CHECK(boundary.is_open(a, b));
  CHECK_FALSE(boundary.accepts({a, b, tip}));  // wound like the face that is there
  CHECK(boundary.accepts({b, a, tip}));
  boundary.add({b, a, tip});
  CHECK_FALSE(boundary.is_open(a, b));
  CHECK_FALSE(boundary.accepts(
      {b, a, boundary.add_vertex(above.view, {0.25f, -0.8f, 0}, Eigen::Vector3f::UnitZ())}));  // a third
}

TEST_CASE("a hole is filled, its loop closed, and the outer rim left as it is") {
  const Above above;
  const auto map = height_field(10, 10, 0.1f, cells(0.3));
  Boundary boundary;
  boundary.build(*map, above.view, faces_in(*map, 0.4f, 0.4f, 0.6f, 0.6f));
  std::vector<RimFace> faces;
  HoleSettings settings;
  fill_holes(above.view, settings, boundary, faces);
  CHECK(faces.size() == 6);  // eight edges
  CHECK(open_edges(boundary) == 40);
  for (const auto& f : faces) {
    const auto &p = boundary.vertex[f[0]].position, &q = boundary.vertex[f[1]].position,
               &r = boundary.vertex[f[2]].position;
    CHECK((q - p).cross(r - p).z() > 0);
  }
}

TEST_CASE("a hole stays where the image sees through it, or where it is too large") {
  const auto map = height_field(10, 10, 0.1f);
  std::vector<RimFace> faces;
  {
    const Above through(2.5f);
    Boundary boundary;
    boundary.build(*map, through.view, faces_in(*map, 0.4f, 0.4f, 0.6f, 0.6f));
    fill_holes(through.view, {}, boundary, faces);
  }
  {
    const Above above;
    Boundary boundary;
    boundary.build(*map, above.view, faces_in(*map, 0.2f, 0.2f, 0.8f, 0.8f));
    HoleSettings settings;
    settings.edges_most = 12;
    fill_holes(above.view, settings, boundary, faces);
  }
  CHECK(faces.empty());
}

TEST_CASE("two holes that touch in a vertex are filled as two") {
  const Above above;
  const auto map = height_field(10, 10, 0.1f);
  auto holes = faces_in(*map, 0.3f, 0.3f, 0.5f, 0.5f);
  const auto second = faces_in(*map, 0.5f, 0.5f, 0.7f, 0.7f);
  holes.insert(holes.end(), second.begin(), second.end());
  std::sort(holes.begin(), holes.end());
  Boundary boundary;
  boundary.build(*map, above.view, holes);
  std::vector<RimFace> faces;
  fill_holes(above.view, {}, boundary, faces);
  CHECK(faces.size() == 12);
  CHECK(open_edges(boundary) == 40);
}

TEST_CASE("a slit closes like a zip") {
  // A row of squares is taken away between x = 0.4 and 0.5, and the gap narrowed to 2 cm.
  const Above above;
  PpmEdit edit(height_field(10, 10, 0.1f));
  for (const auto& f : faces_in(edit.map(), 0.4f, 0.1f, 0.5f, 0.9f)) edit.remove_face(f.chunk, f.face);
  const auto& geometry = *edit.map().table()[0].geometry;
  for (std::uint32_t v = 0; v < geometry.position.size(); ++v)
    if (std::abs(geometry.position[v].x() - 0.5f) < 0.01f && geometry.position[v].y() > 0.11f &&
        geometry.position[v].y() < 0.89f)
      edit.move_vertex(0, v, {0.42f, geometry.position[v].y(), 0});
  const auto map = edit.commit();
  Boundary boundary;
  boundary.build(*map, above.view, {});
  const auto before = open_edges(boundary);
  std::vector<RimFace> faces;
  NotchSettings settings;
  settings.triangle.own_share = 1;
  fill_notches(above.view, std::vector<std::uint8_t>(80 * 60, 0), settings, boundary, faces);
  CHECK(before == 58);
  CHECK(open_edges(boundary) <= 44);
}
