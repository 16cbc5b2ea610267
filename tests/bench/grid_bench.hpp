#pragma once
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <string>

#include "framework/graph/harness.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/slam/depth_score.hpp"
#include "modules/builtin.hpp"

namespace ppm::bench {

/// Maps the frames of a source with their reference poses and scores the held-out ones, by the same frames, pixels and
/// definitions as `ppm run` (docs/metrics.md), for maps that are not ppm's own. Prints one line of JSON.
/// GridMap: void integrate(const Frame&); Prediction predict(const Camera&, const Pose&); std::int64_t bytes().
template <class GridMap>
int map_and_score(const std::string& name, double resolution_m, GridMap& map, const std::string& source_module,
                  const std::string& source_params) {
  constexpr int kStep = 8;  // as held-out depth is scored
  Registry registry;
  register_builtin(registry);
  Harness source(registry, source_module, source_params);
  double seconds = 0;
  int frames = 0;
  while (source.tick()) {
    const auto frame = source.output<Frame>("frame");
    const auto start = std::chrono::steady_clock::now();
    map.integrate(*frame);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++frames;
  }
  auto& sequence = dynamic_cast<FrameSource&>(source.module());
  DepthScorer scorer;
  for (auto index : sequence.held_out()) {
    const Frame frame = sequence.full_frame(index);
    const Camera camera = DepthScorer::sampling_camera(frame.camera, kStep);
    scorer.add(frame, map.predict(camera, *frame.T_world_camera_ref), kStep);
  }
  const DepthScore s = scorer.score();
  fmt::print(
      "{{\"map\": \"{}\", \"resolution_m\": {}, \"frames\": {}, \"bytes\": {}, \"frames_per_s\": {:.1f}, "
      "\"coverage\": {:.4f}, \"median_mm\": {:.2f}, \"within_1cm\": {:.3f}, \"within_2cm\": {:.3f}, "
      "\"within_5cm\": {:.3f}, \"mean_trunc20cm_mm\": {:.2f}}}\n",
      name, resolution_m, frames, map.bytes(), frames / seconds, s.coverage, s.median_mm, s.within_1cm, s.within_2cm,
      s.within_5cm, s.mean_trunc20cm_mm);
  return 0;
}

/// A hit of a ray for a Prediction: at that range, facing the ray, with no texture.
inline void set_hit(Prediction& out, std::size_t pixel, double range, const Eigen::Vector3d& direction,
                    double variance) {
  out.range[pixel] = static_cast<float>(range);
  out.variance[pixel] = static_cast<float>(variance);
  out.chunk[pixel] = 0;
  for (std::size_t k = 0; k < 3; ++k)
    out.normal[3 * pixel + k] = -static_cast<float>(direction[static_cast<Eigen::Index>(k)]);
}

}  // namespace ppm::bench
