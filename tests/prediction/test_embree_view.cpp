#include <catch2/catch.hpp>

#include "framework/core/se3.hpp"
#include "modules/prediction/embree_scenes.hpp"
#include "modules/prediction/embree_view.hpp"
#include "tests/prediction/ray_oracle.hpp"
#include "tests/support/mesh_map.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

const Camera kCamera{37, 29, 30, 32, 18, 14};  // sides that no packet divides
const Pose kAskew =
    se3_exp((Twist() << 0.013, -0.021, 0.1, 0.02, -0.01, 0.03).finished());  // off the grid of the height field

Prediction view_of(const PpmMap& map, const Camera& camera, const Pose& pose, EmbreeViewOptions view = {},
                   EmbreeOptions options = {}) {
  Workers workers(1);
  EmbreeScenes scenes(options);
  scenes.update({&map}, workers);
  Prediction out;
  out.reset(camera, 1, pose);
  trace_view(map, scenes.of(map), view, all_rows(out.camera), out);
  return out;
}

// The same, rows 16 at a time, last rows first.
Prediction view_in_bands(const PpmMap& map, const Camera& camera, const Pose& pose) {
  Workers workers(1);
  EmbreeScenes scenes(EmbreeOptions{});
  scenes.update({&map}, workers);
  Prediction out;
  out.reset(camera, 1, pose);
  for (int first = (camera.rows - 1) / 16 * 16; first >= 0; first -= 16)
    trace_view(map, scenes.of(map), {}, {first, std::min(first + 16, camera.rows)}, out);
  return out;
}

// How far off a face, as a share of it, single precision may put a ray: an edge or a grazing face decides nothing below
// it.
double slack_of(const Geometry& g, std::uint32_t f, double range, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d p0 = g.position[g.face[f][0]].cast<double>();
  const Eigen::Vector3d e1 = g.position[g.face[f][1]].cast<double>() - p0,
                        e2 = g.position[g.face[f][2]].cast<double>() - p0;
  const double height = e1.cross(e2).norm() / std::max({e1.norm(), e2.norm(), (e2 - e1).norm()});
  const double cosine = std::abs(e1.cross(e2).normalized().dot(direction));
  return 4e-6 * (1 + range) / (height * cosine + 1e-12);
}

// True where the pixel's answer is one that exact arithmetic could give within rounding: it hits a face that the ray
// meets (or nearly does), and nothing that the ray surely meets is in front of it.
bool explained(const PpmMap& map, const Prediction& p, std::size_t pixel, bool cull) {
  const Eigen::Vector3d origin = p.T_map_camera.translation(), d = p.direction(pixel);
  const auto wide = all_hits(map, origin, d, false, 0.5);
  bool own = !p.hit(pixel);
  for (const auto& h : wide) {
    const Geometry& g = *map.table()[h.chunk].geometry;
    const double slack = slack_of(g, h.face, h.range, d);
    const double margin = std::min({h.u, h.v, 1 - h.u - h.v});
    const bool back = g.face_normal(h.face).cast<double>().dot(d) > 0;
    if (h.chunk == p.chunk[pixel] && h.face == p.face[pixel])
      own = margin > -slack && std::abs(h.range - p.range[pixel]) < slack * (1 + h.range) + 1e-5;
    else if (margin > slack && !(cull && back) && h.range > 1e-5 && h.range < p.range[pixel] - slack - 1e-5)
      return false;
  }
  return own;
}

void compare(const PpmMap& map, const Pose& pose, const EmbreeViewOptions& view, const EmbreeOptions& options) {
  const Prediction p = view_of(map, kCamera, pose, view, options);
  int hits = 0, same = 0;
  for (std::size_t i = 0; i < p.range.size(); ++i) {
    const OracleHit exact = nearest_hit(all_hits(map, pose.translation(), p.direction(i), view.cull_back_faces, 0));
    hits += p.hit(i);
    if (exact.chunk == p.chunk[i] && (!p.hit(i) || exact.face == p.face[i])) {
      ++same;
      if (!p.hit(i)) continue;
      CHECK(p.range[i] == Approx(exact.range).epsilon(2e-4).margin(2e-4));
      continue;
    }
    INFO("pixel " << i << " chunk " << p.chunk[i] << " face " << p.face[i] << " range " << p.range[i]
                  << " oracle chunk " << exact.chunk << " face " << exact.face << " range " << exact.range);
    CHECK(explained(map, p, i, view.cull_back_faces));
  }
  CHECK(hits > 100);
  CHECK(same > 0.99 * static_cast<double>(p.range.size()));
}

Pose random_pose(std::uint64_t seed) {
  Rng rng(seed, 0, 0, purpose_key("pose"));
  Twist xi;
  for (int i = 0; i < 6; ++i) xi[i] = (i < 3 ? 1.0 : 2.0) * rng.normal();
  return se3_exp(xi);
}

}  // namespace

TEST_CASE("views agree with brute force on triangle soups") {
  const int packet = GENERATE(1, 4, 8, 16);
  const bool cull = GENERATE(true, false);
  const bool robust = GENERATE(true, false);
  EmbreeViewOptions view;
  view.packet = packet;
  EmbreeOptions options;
  view.cull_back_faces = cull;
  options.robust = robust;
  PpmSettings settings;
  settings.cell_size_m = 4.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto map = make_map(triangle_soup(300, seed), settings);
    CAPTURE(packet, cull, robust, seed);
    compare(*map, random_pose(seed), view, options);
  }
}

TEST_CASE("views agree with brute force on a mesh cut into chunks, which leaves no cracks") {
  const auto wave =
      height_field(24, 3.f, [](float x, float y) { return 2.f + 0.3f * std::sin(3 * x) * std::cos(2 * y); });
  PpmSettings settings;
  settings.cell_size_m = GENERATE(0.4, 1.0, 20.0);
  const auto map = make_map(wave, settings);
  EmbreeViewOptions view;
  view.packet = GENERATE(1, 4, 8, 16);
  view.coherent = GENERATE(true, false);
  CAPTURE(settings.cell_size_m, view.packet, view.coherent);
  compare(*map, kAskew, view, {});
  const Prediction p = view_of(*map, kCamera, kAskew, view);
  for (std::size_t i = 0; i < p.range.size(); ++i) CHECK(p.hit(i));
}

TEST_CASE("rows traced in bands are the same bytes as rows traced together") {
  PpmSettings settings;
  settings.cell_size_m = 0.5;
  const auto map = make_map(height_field(24, 3.f, [](float x, float y) { return 2.f + 0.2f * x * y; }), settings);
  const Prediction whole = view_of(*map, kCamera, kAskew), bands = view_in_bands(*map, kCamera, kAskew);
  CHECK(std::count_if(whole.chunk.begin(), whole.chunk.end(), [](auto c) { return c != Prediction::kNone; }) > 1000);
  CHECK(bands.range == whole.range);
  CHECK(bands.mean == whole.mean);
  CHECK(bands.face == whole.face);
  CHECK(bands.bary == whole.bary);
}
