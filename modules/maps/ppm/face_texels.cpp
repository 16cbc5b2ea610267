#include "modules/maps/ppm/face_texels.hpp"

namespace ppm {

FaceTexels::FaceTexels(const PpmChunk& chunk, std::uint32_t face)
    : n_(chunk.geometry->divisions[face]),
      texels_(chunk.texels->view(chunk.geometry->first_texel[face], texel_count(n_))),
      added_variance_(chunk.texels->evidence[face].added_variance()),
      normal_(chunk.geometry->face_normal(face)) {}

std::uint32_t FaceTexels::on_side(std::uint32_t k, std::uint32_t s) const {
  return k == 0 ? texel_index(n_, s, 0) : k == 1 ? texel_index(n_, n_ - s, s) : texel_index(n_, 0, n_ - s);
}

void FaceTexels::add(std::uint32_t i, std::uint32_t j, const Eigen::Vector3f& normal, MeshNode& node) const {
  const auto t = texel_index(n_, i, j);
  node.offset.add(texels_.mean[t], texels_.variance[t] + added_variance_, normal_.dot(normal));
  if (!texels_.color.empty()) node.color.add(texel_color(texels_, t).cast<double>(), texels_.color_variance[t]);
}

void FaceTexels::add_on_side(std::uint32_t k, double s, const Eigen::Vector3f& normal, MeshNode& node) const {
  const double x = s * n_;
  const auto before = std::min(static_cast<std::uint32_t>(x), n_ - 1);
  const double w = x - before;
  const auto a = on_side(k, before), b = on_side(k, before + 1);
  auto between = [w, a, b](std::span<const float> values) { return (1 - w) * values[a] + w * values[b]; };
  node.offset.add(between(texels_.mean), between(texels_.variance) + added_variance_, normal_.dot(normal));
  if (texels_.color.empty()) return;
  const Eigen::Vector3d color =
      (1 - w) * texel_color(texels_, a).cast<double>() + w * texel_color(texels_, b).cast<double>();
  node.color.add(color, between(texels_.color_variance));
}

}  // namespace ppm
