// The update on real frames with known poses: what the map predicts of frames that it has not seen, and whether it is
// one layer.
#include <catch2/catch.hpp>
#include <map>

#include "framework/graph/harness.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/slam/depth_score.hpp"
#include "modules/builtin.hpp"
#include "tests/map_update/mapper.hpp"
#include "tests/support/data.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

/// Edges with one face, a square metre of surface.
double open_edges_per_m2(const PpmMap& map) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces;
  double area = 0;
  for (const auto& chunk : map.table().chunks()) {
    const Geometry& g = *chunk.geometry;
    for (const auto& f : g.face) {
      area += 0.5 * (g.position[f[1]] - g.position[f[0]]).cross(g.position[f[2]] - g.position[f[0]]).norm();
      for (std::size_t k = 0; k < 3; ++k) ++faces[std::minmax(g.vertex_id[f[k]], g.vertex_id[f[(k + 1) % 3]])];
    }
  }
  int open = 0;
  for (const auto& [edge, n] : faces) open += n == 1;
  return open / area;
}

}  // namespace

TEST_CASE("kitchen: frames that were held out are predicted by one layer of surface") {
  const auto folder = data_path("kitchen");
  if (!folder) return;
  Registry registry;
  register_builtin(registry);
  Harness source(
      registry, "source.seven_scenes",
      fmt::format("{{path: {}, last: 119, stride: 2, pixel_stride: 2, holdout: every 10th}}", folder->string()));
  Mapper mapper;
  Frame last;
  while (source.tick()) {
    last = *source.output<Frame>("frame");
    mapper.add(last);
  }
  auto& sequence = dynamic_cast<FrameSource&>(source.module());
  DepthScorer scorer;
  for (auto index : sequence.held_out()) {
    const Frame frame = sequence.full_frame(index);
    scorer.add(frame, mapper.predict(DepthScorer::sampling_camera(frame.camera, 8), *frame.T_world_camera_ref), 8);
  }
  const auto score = scorer.score();
  const double layers = mapper.second_layers(last.camera.decimated(2), *last.T_world_camera_ref);
  const double open = open_edges_per_m2(mapper.map());
  fmt::print(
      "kitchen, 60 frames: coverage {:.4f}, median {:.2f} mm, within 5 cm {:.3f}, second layers {:.4f}, open edges "
      "{:.0f} per m2\n",
      score.coverage, score.median_mm, score.within_5cm, layers, open);
  CHECK(score.coverage > 0.96);
  CHECK(score.median_mm < 9);
  CHECK(score.within_5cm > 0.92);
  CHECK(layers < 0.01);
  CHECK(open < 450);
}
