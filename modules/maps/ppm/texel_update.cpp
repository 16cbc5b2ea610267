#include "modules/maps/ppm/texel_update.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {
namespace {

/// A face's plane n . x = offset as the gather form needs it.
struct FacePlane {
  Eigen::Vector3f normal;
  float offset;
  float texel_area;  // m^2, that one node stands for
  float excess;      // m^2
};

/// The residuals of the four pixels around (x, y), weighted bilinearly; false where less than half of the weight is
/// left.
bool interpolate(const UpdateView& view, const FacePlane& plane, float x, float y, float mean, float limit,
                 float& offset) {
  const int x0 = std::clamp(static_cast<int>(std::floor(x)), 0, view.cols() - 2);
  const int y0 = std::clamp(static_cast<int>(std::floor(y)), 0, view.rows() - 2);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const std::array<float, 4> weight{(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
  float sum = 0, total = 0;
  for (int k = 0; k < 4; ++k) {
    const float r = plane.normal.dot(view.point[view.at(x0 + (k & 1), y0 + (k >> 1))]) - plane.offset;
    if (!(std::abs(r - mean) <= limit)) continue;  // also where nothing was measured
    sum += weight[static_cast<std::size_t>(k)] * r;
    total += weight[static_cast<std::size_t>(k)];
  }
  if (total < 0.5f) return false;
  offset = sum / total;
  return true;
}

void gather_node(const UpdateView& view, const TexelSettings& settings, const FacePlane& plane,
                 const Eigen::Vector3f& node, float& mean, float& variance) {
  const Eigen::Vector3f image = view.project(node);
  if (!(image.z() > 0) || image.x() < 0 || image.y() < 0 || image.x() > static_cast<float>(view.cols() - 1) ||
      image.y() > static_cast<float>(view.rows() - 1))
    return;
  const auto nearest = view.at(static_cast<int>(image.x() + 0.5f), static_cast<int>(image.y() + 0.5f));
  if (!view.measured(nearest)) return;
  const float cosine = std::max(UpdateView::facing(plane.normal, node), settings.gate.least_cosine);
  const float sigma = view.sigma[nearest];
  const float limit = settings.gate_sigmas * settings.gate.spread(sigma, cosine, variance + plane.excess);
  float offset = 0;
  if (!interpolate(view, plane, image.x(), image.y(), mean, limit, offset)) return;
  const float pixel = image.z() * view.inv_fx;
  const float footprint = pixel * pixel / cosine;
  const float share = std::min(1.0f, plane.texel_area / footprint);
  fuse(mean, variance, offset, variance_along_normal(sigma, cosine, view.lateral_px * pixel) / share);
}

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

/// Gathers for a face of the map.
void gather_map_face(const UpdateView& view, const TexelSettings& settings, const Geometry& geometry, std::uint32_t f,
                     Texels& texels) {
  const auto first = geometry.first_texel[f];
  const auto count = texel_count(geometry.divisions[f]);
  gather_face(view, settings, corners_in(view, geometry, f), geometry.divisions[f], texels.evidence[f].added_variance(),
              {&texels.mean[first], count}, {&texels.variance[first], count});
}

}  // namespace

float variance_along_normal(float sigma, float cosine, float lateral) {
  const float c2 = cosine * cosine;
  return sigma * sigma * c2 + lateral * lateral * (1 - c2);
}

void gather_face(const UpdateView& view, const TexelSettings& settings, const std::array<Eigen::Vector3f, 3>& corner,
                 std::uint32_t divisions, float excess, std::span<float> mean, std::span<float> variance) {
  const Eigen::Vector3f e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
  const Eigen::Vector3f cross = e1.cross(e2);
  const float twice_area = cross.norm();
  const auto n = static_cast<float>(divisions);
  const FacePlane plane{cross / twice_area, cross.dot(corner[0]) / twice_area, twice_area / (n * n), excess};
  if (plane.offset >= 0) return;  // seen from behind
  std::size_t t = 0;
  for (std::uint32_t i = 0; i <= divisions; ++i)
    for (std::uint32_t j = 0; i + j <= divisions; ++j, ++t) {
      const Eigen::Vector3f node = corner[0] + e1 * (static_cast<float>(i) / n) + e2 * (static_cast<float>(j) / n);
      gather_node(view, settings, plane, node, mean[t], variance[t]);
    }
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
  for_each_face(faces, workers, edit, [&](const Geometry& geometry, std::uint32_t face, Texels& texels) {
    gather_map_face(view, settings, geometry, face, texels);
  });
}

}  // namespace ppm
