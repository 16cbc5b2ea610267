#include "modules/maps/ppm/texel_update.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {
namespace {

void scatter_pixel(const UpdateView& view, const TexelSettings& settings, std::size_t p, PpmEdit& edit) {
  const Prediction& seen = *view.prediction;
  const auto& geometry = *edit.map().table()[seen.chunk[p]].geometry;
  const auto f = seen.face[p];
  const Eigen::Vector3f normal = geometry.face_normal(f);
  const float facing = UpdateView::facing(normal, view.point[p]);
  if (facing <= 0) return;
  const float cosine = std::max(facing, settings.gate.least_cosine);
  const auto t = geometry.first_texel[f] + nearest_texel(geometry.divisions[f], seen.bary[2 * p], seen.bary[2 * p + 1]);
  Texels& texels = edit.texels(seen.chunk[p]);
  const float offset = normal.dot(view.point[p] - view.relative(geometry.position[geometry.face[f][0]]));
  const float excess = texels.evidence[f].added_variance();
  const float limit = settings.gate_sigmas * settings.gate.spread(view.sigma[p], cosine, texels.variance[t] + excess);
  if (std::abs(offset - texels.mean[t]) > limit) return;
  const float pixel = view.depth[p] * std::abs(view.inv_fx);
  fuse(texels.mean[t], texels.variance[t], offset,
       variance_along_normal(view.sigma[p], cosine, view.lateral_px * pixel));
}

/// The gather form for faces of the map, ascending.
void gather_map_faces(const UpdateView& view, const TexelSettings& settings, const std::vector<FaceRef>& faces,
                      const Workers& workers, PpmEdit& edit) {
  const GatherImage image = gather_image(view);
  const GatherGate gate = gather_gate(settings);
  std::vector<Texels*> texels(edit.map().table().size(), nullptr);
  for (const auto& f : faces)
    if (!texels[f.chunk]) texels[f.chunk] = &edit.texels(f.chunk);
  constexpr std::size_t kTurn = 256;  // faces
  workers.for_each((faces.size() + kTurn - 1) / kTurn, [&](std::size_t turn, int) {
    std::array<std::uint32_t, kTurn> numbers;
    const std::size_t end = std::min((turn + 1) * kTurn, faces.size());
    for (std::size_t i = turn * kTurn; i < end;) {
      const auto chunk = faces[i].chunk;
      std::size_t count = 0;
      for (; i < end && faces[i].chunk == chunk; ++i) numbers[count++] = faces[i].face;
      gather_faces(image, gate, gather_faces_of(*edit.map().table()[chunk].geometry, *texels[chunk]), numbers.data(),
                   count);
    }
  });
}

}  // namespace

float variance_along_normal(float sigma, float cosine, float lateral) {
  const float c2 = cosine * cosine;
  return sigma * sigma * c2 + lateral * lateral * (1 - c2);
}

GatherImage gather_image(const UpdateView& view) {
  GatherImage image = gather_image(view.camera, view.prediction->T_map_camera);
  image.lateral_px = view.lateral_px;
  image.row_step = view.cols();
  image.depth = view.depth.data();
  image.sigma = view.sigma.data();
  return image;
}

GatherImage gather_image(const Camera& camera, const Pose& T_map_camera) {
  const Eigen::Matrix3f axes = T_map_camera.linear().cast<float>();
  GatherImage image;
  image.cols = camera.cols;
  image.rows = camera.rows;
  image.fx = static_cast<float>(camera.fx);
  image.fy = static_cast<float>(camera.fy);
  image.cx = static_cast<float>(camera.cx);
  image.cy = static_cast<float>(camera.cy);
  image.inv_fx = static_cast<float>(1.0 / camera.fx);
  image.inv_fy = static_cast<float>(1.0 / camera.fy);
  std::copy_n(axes.data(), 9, image.axes);
  for (int k = 0; k < 3; ++k) {
    const double centre = T_map_camera.translation()[k];
    image.centre[k] = static_cast<float>(centre);
    image.centre_rest[k] = static_cast<float>(centre - image.centre[k]);
  }
  return image;
}

GatherGate gather_gate(const TexelSettings& settings) {
  const SurfaceGate& gate = settings.gate;
  return {settings.gate_sigmas, gate.pose_sigma * gate.pose_sigma, gate.map_sigma_most * gate.map_sigma_most,
          gate.least_cosine};
}

GatherFaces gather_faces_of(const Geometry& geometry, Texels& texels) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float) && sizeof(FaceEvidence) % sizeof(float) == 0);
  if (geometry.face.empty()) return {};
  return {geometry.position.data()->data(),
          geometry.face.data()->data(),
          geometry.divisions.data(),
          geometry.first_texel.data(),
          &texels.evidence.data()->excess,
          sizeof(FaceEvidence) / sizeof(float),
          texels.mean.data(),
          texels.variance.data()};
}

void gather_face(const UpdateView& view, const TexelSettings& settings, const std::array<Eigen::Vector3f, 3>& corner,
                 std::uint32_t divisions, float excess, std::span<float> mean, std::span<float> variance) {
  GatherImage image = gather_image(view);
  std::fill_n(image.centre, 3, 0.0f);  // corners are relative to it
  std::fill_n(image.centre_rest, 3, 0.0f);
  const std::array<std::uint32_t, 3> corners{0, 1, 2};
  const auto n = static_cast<std::uint8_t>(divisions);
  const std::uint32_t first = 0;
  gather_faces(image, gather_gate(settings),
               {corner[0].data(), corners.data(), &n, &first, &excess, 1, mean.data(), variance.data()}, &first, 1);
}

void start_texels(const UpdateView& view, const TexelSettings& settings, const std::array<Eigen::Vector3f, 3>& corner,
                  std::uint32_t divisions, float prior_variance, float excess, std::span<float> mean,
                  std::span<float> variance) {
  std::fill(mean.begin(), mean.end(), 0.0f);
  std::fill(variance.begin(), variance.end(), prior_variance);
  if (settings.new_texels == NewTexels::measured)
    return gather_face(view, settings, corner, divisions, excess, mean, variance);
  const Eigen::Vector3f centroid = (corner[0] + corner[1] + corner[2]) / 3;
  const Eigen::Vector3f image = view.project(centroid);
  const int x = static_cast<int>(std::lround(image.x())), y = static_cast<int>(std::lround(image.y()));
  if (!view.inside(x, y) || !view.measured(view.at(x, y))) return;
  const Eigen::Vector3f normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  const float cosine = std::max(UpdateView::facing(normal, centroid), settings.gate.least_cosine);
  const float lateral = view.lateral_px * image.z() * view.inv_fx;
  std::fill(variance.begin(), variance.end(), variance_along_normal(view.sigma[view.at(x, y)], cosine, lateral));
}

std::array<Eigen::Vector3f, 3> corners_in(const UpdateView& view, const Geometry& geometry, std::uint32_t face) {
  const auto& [i, j, k] = geometry.face[face];
  return {view.relative(geometry.position[i]), view.relative(geometry.position[j]),
          view.relative(geometry.position[k])};
}

void for_each_face(const std::vector<FaceRef>& faces, const Workers& workers, PpmEdit& edit,
                   const std::function<void(const Geometry&, std::uint32_t, Texels&)>& body) {
  std::vector<Texels*> texels(edit.map().table().size(), nullptr);
  for (const auto& f : faces)
    if (!texels[f.chunk]) texels[f.chunk] = &edit.texels(f.chunk);
  constexpr std::size_t kTurn = 64;  // faces
  workers.for_each((faces.size() + kTurn - 1) / kTurn, [&](std::size_t turn, int) {
    for (std::size_t i = turn * kTurn; i < std::min((turn + 1) * kTurn, faces.size()); ++i) {
      const auto [chunk, face] = faces[i];
      body(*edit.map().table()[chunk].geometry, face, *texels[chunk]);
    }
  });
}

void update_texels(const UpdateView& view, const std::vector<std::uint8_t>& classes, const std::vector<FaceRef>& faces,
                   const TexelSettings& settings, const Workers& workers, PpmEdit& edit) {
  if (settings.form == TexelForm::scatter) {
    for (std::size_t p = 0; p < classes.size(); ++p)
      if (classes[p] & kOwnHit) scatter_pixel(view, settings, p, edit);
    return;
  }
  gather_map_faces(view, settings, faces, workers, edit);
}

}  // namespace ppm
