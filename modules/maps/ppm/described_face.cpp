#include "modules/maps/ppm/described_face.hpp"

namespace ppm {

FaceCorners face_corners(const Geometry& geometry, std::size_t f) {
  const auto& [a, b, c] = geometry.face[f];
  return {geometry.position[a], geometry.position[b], geometry.position[c]};
}

Eigen::Vector3f triangle_normal(const FaceCorners& corner) {
  const Eigen::Vector3d a = corner[0].cast<double>();
  return (corner[1].cast<double>() - a).cross(corner[2].cast<double>() - a).normalized().cast<float>();
}

DescribedFace::DescribedFace(const FaceCorners& corner, std::uint32_t divisions, std::span<const float> mean)
    : origin_(corner[0]), normal_(triangle_normal(corner)), divisions_(divisions), mean_(mean) {
  const Eigen::Vector3f e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
  const float area = normal_.dot(e1.cross(e2));
  dual_u_ = e2.cross(normal_) / area;  // dual_u . e1 = 1, dual_u . e2 = 0
  dual_v_ = normal_.cross(e1) / area;
}

float DescribedFace::meet(const Eigen::Vector3f& point, const Eigen::Vector3f& direction) const {
  constexpr int kSteps = 4;  // each leaves of the error the product of the surface's slope and the line's slant
  const Eigen::Vector3f start = point - origin_;
  const float height = normal_.dot(start), climb = normal_.dot(direction);
  float along = -height / climb;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Vector3f p = start + along * direction;
    const float u = std::max(dual_u_.dot(p), 0.0f), v = std::max(dual_v_.dot(p), 0.0f), sum = std::max(u + v, 1.0f);
    const TexelTriangle t = texel_triangle(divisions_, u / sum, v / sum);
    const float mean =
        t.weight[0] * mean_[t.texel[0]] + t.weight[1] * mean_[t.texel[1]] + t.weight[2] * mean_[t.texel[2]];
    along = (mean - height) / climb;
  }
  return along;
}

void DescribedFace::reexpress(const FaceCorners& corner, std::span<float> mean) const {
  const Eigen::Vector3f direction = triangle_normal(corner);
  std::size_t t = 0;
  for (std::uint32_t i = 0; i <= divisions_; ++i)
    for (std::uint32_t j = 0; i + j <= divisions_; ++j)
      mean[t++] = meet(texel_place(corner, divisions_, i, j), direction);
}

}  // namespace ppm
