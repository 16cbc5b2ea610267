#include "apps/bench/kernel_work.hpp"

#include <algorithm>
#include <cmath>

#include "modules/maps/ppm/visible_chunks.hpp"

namespace ppm {
namespace {

/// What a view of a scene consists of, on average over the world's images.
struct SceneCounts {
  double vertices = 0, faces = 0;  ///< of the chunks in the image
  double drawn = 0;                ///< faces that are seen from their front and whose box has pixels
  double candidates = 0;           ///< pixels of those boxes
  double pixels = 0, texels = 0;   ///< of the image; of the chunks in it
};

/// Pixels in the box of a face's image; 0 where it is seen from behind or passes the camera's plane.
double box_pixels(const Camera& camera, const Eigen::Vector3d (&corner)[3]) {
  if (std::min({corner[0].z(), corner[1].z(), corner[2].z()}) <= 0) return 0;
  if (corner[0].dot((corner[1] - corner[0]).cross(corner[2] - corner[0])) >= 0) return 0;
  Eigen::AlignedBox2d box;
  for (const auto& c : corner) box.extend(camera.project(c));
  const auto pixels = [](double least, double most, int size) {
    return std::max(0.0, std::floor(std::min(most, size - 1.0)) - std::ceil(std::max(least, 0.0)) + 1);
  };
  return pixels(box.min().x(), box.max().x(), camera.cols) * pixels(box.min().y(), box.max().y(), camera.rows);
}

void count_chunk(const PpmChunk& chunk, const Camera& camera, const Pose& T_camera_map, SceneCounts& counts) {
  const Geometry& g = *chunk.geometry;
  counts.vertices += static_cast<double>(g.position.size());
  counts.faces += static_cast<double>(g.face.size());
  counts.texels += static_cast<double>(chunk.texels->size());
  for (const auto& f : g.face) {
    const auto at = [&](std::uint32_t v) { return Eigen::Vector3d(T_camera_map * g.position[v].cast<double>()); };
    const Eigen::Vector3d corner[3] = {at(f[0]), at(f[1]), at(f[2])};
    const double pixels = box_pixels(camera, corner);
    counts.drawn += pixels > 0;
    counts.candidates += pixels;
  }
}

SceneCounts count(const BenchWorld& world) {
  SceneCounts counts;
  for (const auto& frame : world.frames) {
    counts.pixels += frame->camera.pixels();
    const Pose& view = *frame->T_world_camera_ref;
    for (const auto& v : visible_chunks(*world.map, frame->camera, view))
      count_chunk(world.map->table()[v.chunk], frame->camera, view.inverse(), counts);
  }
  for (double* n : {&counts.vertices, &counts.faces, &counts.drawn, &counts.candidates, &counts.pixels, &counts.texels})
    *n /= static_cast<double>(world.frames.size());
  return counts;
}

/// Least ms of the case of that name; NaN where it was not measured.
double ms_of(const std::vector<BenchResult>& results, const std::string& name) {
  for (const auto& r : results)
    if (r.of->name() == name && r.left_out.empty()) return r.ms_best;
  return NAN;
}

double roof(const std::vector<BenchResult>& results, const std::string& of) {
  for (const auto& r : results)
    if (r.of->name() == "roof/" + of + "/threads:1" && r.left_out.empty()) return 1e12 / r.ms_best;  // items are 1e9
  return NAN;
}

}  // namespace

std::vector<KernelShare> kernel_shares(const BenchPlan& plan, const std::vector<BenchResult>& results) {
  const int triangles = plan.triangles[plan.triangles.size() > 1];
  const auto size = fmt::format("triangles:{}", triangles);
  const double view = ms_of(results, "view/prediction.raster/" + size);
  const double weigh = ms_of(results, "weigh/prediction.raster/weighting.robust/" + size);
  const double update =
      ms_of(results, fmt::format("update/prediction.raster/cloned/keyframes_and_texels/{}/particles:{}/threads:1", size,
                                 plan.particles));
  if (std::isnan(view) && std::isnan(update)) return {};
  const SceneCounts n = count(plan.worlds.of(triangles, plan.cols));
  std::vector<KernelShare> shares{
      {"view", view, 24 * n.vertices + 20 * n.faces + 85 * n.drawn + 16 * n.candidates,
       12 * n.vertices + 12 * n.faces + 64 * n.drawn + 8 * n.pixels, 0, 0,
       fmt::format(
           "{:.0f} vertices of 24 flops and 12 bytes, {:.0f} faces of 20 and 12, {:.0f} of them drawn, of 85 and 64, "
           "{:.0f} pixels in their boxes of 16 flops, {:.0f} in the image of 8 bytes",
           n.vertices, n.faces, n.drawn, n.candidates, n.pixels)},
      {"attributes and likelihood", weigh - view, 90 * n.pixels, 105 * n.pixels, 0, 0,
       fmt::format(
           "{:.0f} pixels of 90 flops (ray on its face 46, texels 12, likelihood 32) and 105 bytes (face 61, texels "
           "24, measurement 20)",
           n.pixels)},
      {"update, chunks cloned", update, 60 * n.pixels + 60 * n.texels, 45 * n.pixels + 32 * n.texels, 0, 0,
       fmt::format(
           "{:.0f} pixels of 60 flops and 45 bytes; {:.0f} texels in the chunks seen, of 60 flops, 16 bytes to clone "
           "and 16 to write",
           n.pixels, n.texels)}};
  for (auto& s : shares) {
    s.flops_share = s.flops / (1e-3 * s.ms) / roof(results, "flops");
    s.read_share = s.bytes / (1e-3 * s.ms) / roof(results, "read");
    if (std::isnan(s.flops_share)) s.flops_share = 0;
    if (std::isnan(s.read_share)) s.read_share = 0;
  }
  std::erase_if(shares, [](const KernelShare& s) { return !(s.ms > 0); });
  return shares;
}

std::string kernel_table(const std::vector<KernelShare>& shares) {
  std::string text = "How near to the roofs of one thread, by what the work takes at least:\n";
  for (const auto& s : shares) {
    text += fmt::format("{}: {:.3g} ms, {:.3g} Mflop ({:.1f} GFLOP/s", s.kernel, s.ms, 1e-6 * s.flops,
                        1e-6 * s.flops / s.ms);
    if (s.flops_share > 0) text += fmt::format(", {:.1f} %", 100 * s.flops_share);
    text += fmt::format("), {:.3g} MB ({:.1f} GB/s", 1e-6 * s.bytes, 1e-6 * s.bytes / s.ms);
    if (s.read_share > 0) text += fmt::format(", {:.1f} %", 100 * s.read_share);
    text += "): " + s.basis + "\n";
  }
  return text;
}

}  // namespace ppm
