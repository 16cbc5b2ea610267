#include "modules/maps/ppm/described_face.hpp"

namespace ppm {
namespace {

float weighted(const TexelTriangle& t, std::span<const float> value, std::size_t stride = 1, std::size_t offset = 0) {
  float sum = 0;
  for (int k = 0; k < 3; ++k) sum += t.weight[k] * value[stride * t.texel[k] + offset];
  return sum;
}

}  // namespace

Eigen::Vector3f triangle_normal(const FaceCorners& corner) {
  const Eigen::Vector3d a = corner[0].cast<double>();
  return (corner[1].cast<double>() - a).cross(corner[2].cast<double>() - a).normalized().cast<float>();
}

FaceCorners face_corners(const Geometry& geometry, std::size_t f) {
  const auto& [a, b, c] = geometry.face[f];
  return {geometry.position[a], geometry.position[b], geometry.position[c]};
}

DescribedFace::DescribedFace(const FaceCorners& corner, std::uint32_t divisions, const TexelView& texels)
    : origin_(corner[0]), normal_(triangle_normal(corner)), divisions_(divisions), texels_(texels) {
  const Eigen::Vector3f e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
  const float area = normal_.dot(e1.cross(e2));
  dual_u_ = e2.cross(normal_) / area;  // dual_u . e1 = 1, dual_u . e2 = 0
  dual_v_ = normal_.cross(e1) / area;
}

DescribedFace::Meeting DescribedFace::meet(const Eigen::Vector3f& point, const Eigen::Vector3f& direction) const {
  constexpr int kSteps = 4;  // each leaves the product of the surface's slope and the line's slant of the error
  const Eigen::Vector3f start = point - origin_;
  const float height = normal_.dot(start), climb = normal_.dot(direction);
  Meeting meeting{-height / climb, {}};
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Vector3f p = start + meeting.along * direction;
    float u = std::max(dual_u_.dot(p), 0.0f), v = std::max(dual_v_.dot(p), 0.0f);
    const float sum = std::max(u + v, 1.0f);
    meeting.at = texel_triangle(divisions_, u / sum, v / sum);
    meeting.along = (weighted(meeting.at, texels_.mean) - height) / climb;
  }
  return meeting;
}

void DescribedFace::reexpress(const FaceCorners& corner, std::uint32_t divisions, TexelArrays& texels) const {
  const Eigen::Vector3f direction = triangle_normal(corner);
  const std::size_t channels = texels_.mean.empty() ? 0 : texels_.color.size() / texels_.mean.size();
  for (std::uint32_t i = 0; i <= divisions; ++i)
    for (std::uint32_t j = 0; i + j <= divisions; ++j) {
      const auto [along, at] = meet(texel_place(corner, divisions, i, j), direction);
      texels.mean.push_back(along);
      texels.variance.push_back(weighted(at, texels_.variance));
      for (std::size_t c = 0; c < channels; ++c) texels.color.push_back(weighted(at, texels_.color, channels, c));
      if (channels > 0) texels.color_variance.push_back(weighted(at, texels_.color_variance));
    }
}

void DescribedFace::reexpress_means(const FaceCorners& corner, std::span<float> mean) const {
  const Eigen::Vector3f direction = triangle_normal(corner);
  std::size_t t = 0;
  for (std::uint32_t i = 0; i <= divisions_; ++i)
    for (std::uint32_t j = 0; i + j <= divisions_; ++j)
      mean[t++] = meet(texel_place(corner, divisions_, i, j), direction).along;
}

}  // namespace ppm
