#include "modules/maps/ppm/texel_resample.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

constexpr float kReachTexels = 3;  // lines look for the old surface so many texel sizes from the new face
constexpr float kInwards = 1e-3f;  // of the way to the centroid: how far lines start beside the nodes
constexpr int kFitSteps = 6;

float read(std::span<const float> values, const TexelTriangle& t) {
  return t.weight[0] * values[t.texel[0]] + t.weight[1] * values[t.texel[1]] + t.weight[2] * values[t.texel[2]];
}

/// Values at the nodes such that, interpolated, they fit the observations. `value` holds the start. Each step moves a
/// node by the weighted mean of the residuals around it. Interpolation weights sum to one and nodes are observed
/// themselves, so that this contracts in every mode: to a tenth in six steps where it is slowest, which is texture at
/// the frequency of the grid.
void fit_nodes(const std::vector<NodeObservation>& observations, std::span<float> value) {
  std::vector<float> sum(value.size()), weight(value.size(), 0.0f);
  for (const auto& o : observations)
    for (int k = 0; k < 3; ++k) weight[o.node->texel[k]] += o.node->weight[k] * o.weight;
  for (int step = 0; step < kFitSteps; ++step) {
    std::fill(sum.begin(), sum.end(), 0.0f);
    for (const auto& o : observations) {
      const float residual = o.weight * (o.value - read(value, *o.node));
      for (int k = 0; k < 3; ++k) sum[o.node->texel[k]] += o.node->weight[k] * residual;
    }
    for (std::size_t t = 0; t < value.size(); ++t) value[t] += sum[t] / weight[t];
  }
}

/// The mean at each node, over the area that it stands for.
void average_at_nodes(const std::vector<NodeObservation>& observations, std::span<float> value) {
  std::vector<float> weight(value.size(), 0.0f);
  std::fill(value.begin(), value.end(), 0.0f);
  for (const auto& o : observations)
    for (int k = 0; k < 3; ++k) {
      value[o.node->texel[k]] += o.node->weight[k] * o.weight * o.value;
      weight[o.node->texel[k]] += o.node->weight[k] * o.weight;
    }
  for (std::size_t t = 0; t < value.size(); ++t) value[t] /= weight[t];
}

std::uint16_t saturated(double votes) {
  return static_cast<std::uint16_t>(std::min(std::lround(votes), 65535l));
}

}  // namespace

TexelResampler::TexelResampler(std::span<const TexturedFace> old_faces, const PpmSettings& settings, Meeting meeting)
    : old_(old_faces), surface_(old_faces, meeting), sizes_(settings) {
  PPM_CHECK(!old_faces.empty(), "new faces need old ones to take their texels from");
}

ResampledFace TexelResampler::resample(const std::array<Eigen::Vector3f, 3>& corner,
                                       const ResampleTolerance& tolerance) {
  const auto n = sizes_.divisions_for(corner[0], corner[1], corner[2]);
  take_samples(corner, n);
  ResampledFace face;
  face.divisions = static_cast<std::uint8_t>(n);
  face.texels.mean.resize(texel_count(n));
  face.texels.variance.resize(texel_count(n));
  fit_offsets(face.texels);
  if (sizes_.settings().color_channels > 0) fit_colors(face.texels);
  for (const auto& s : sample_) {
    const float distance = std::abs(s.hit.offset - read(face.texels.mean, s.node));
    const float allowed = std::max(tolerance.distance, tolerance.sigmas * std::sqrt(s.sigma2));
    face.error.distance = std::max(face.error.distance, distance);
    face.error.share = std::max(face.error.share, distance / allowed);
    face.error.offset = std::max(face.error.offset, std::abs(s.hit.offset));
    face.error.miss = std::max(face.error.miss, s.hit.miss);
  }
  read_overlap(face);
  return face;
}

/// The nodes first, in the order of texel_index; then the centres.
void TexelResampler::take_samples(const std::array<Eigen::Vector3f, 3>& corner, std::uint32_t n) {
  const Eigen::Vector3f e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], cross = e1.cross(e2);
  const float twice_area = cross.norm();
  surface_.aim({corner[0], e1, e2, cross / twice_area},
               kReachTexels * static_cast<float>(sizes_.settings().texel_size_m));
  const auto steps = static_cast<float>(n);
  const float area = twice_area / (2 * steps * steps);  // of a triangle between nodes
  sample_.clear();
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; i + j <= n; ++j) {
      const int sides = (i == 0) + (j == 0) + (i + j == n);
      const float triangles = sides == 0 ? 6.0f : sides == 1 ? 3.0f : 1.0f;  // that meet in the node
      take_sample(static_cast<float>(i) / steps, static_cast<float>(j) / steps, n, area * triangles / 12);
    }
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; i + j < n; ++j) {
      const float a = (static_cast<float>(i) + 1.0f / 3) / steps, b = (static_cast<float>(j) + 1.0f / 3) / steps;
      const float third = 1 / (3 * steps);
      take_sample(a, b, n, 0.75f * area);
      if (i + j + 2 <= n) take_sample(a + third, b + third, n, 0.75f * area);
    }
}

void TexelResampler::take_sample(float a, float b, std::uint32_t n, float area) {
  // On a border two old faces may meet: just inside there is one.
  const float inner_a = a + kInwards * (1.0f / 3 - a), inner_b = b + kInwards * (1.0f / 3 - b);
  Sample s{texel_triangle(n, inner_a, inner_b), surface_.cast(inner_a, inner_b), area, 0, 0};
  const TexturedFace& old = old_[s.hit.face];
  const float variance = read(old.texels.variance, s.hit.texels);
  for (int k = 0; k < 3; ++k) s.information += s.hit.texels.weight[k] / old.texels.variance[s.hit.texels.texel[k]];
  s.sigma2 = variance + old.evidence.added_variance();
  sample_.push_back(s);
}

void TexelResampler::fit_offsets(TexelArrays& texels) {
  observation_.clear();
  for (const auto& s : sample_) observation_.push_back({&s.node, s.area, s.information});
  average_at_nodes(observation_, texels.variance);
  for (auto& v : texels.variance) v = 1 / v;
  observation_.clear();
  for (const auto& s : sample_) observation_.push_back({&s.node, s.area * s.information, s.hit.offset});
  for (std::size_t t = 0; t < texels.mean.size(); ++t) texels.mean[t] = sample_[t].hit.offset;
  fit_nodes(observation_, texels.mean);
}

void TexelResampler::fit_colors(TexelArrays& texels) {
  const auto channels = static_cast<std::size_t>(sizes_.settings().color_channels), nodes = texels.mean.size();
  texels.color.resize(channels * nodes);
  texels.color_variance.resize(nodes);
  observation_.clear();
  for (const auto& s : sample_) {
    const auto& variance = old_[s.hit.face].texels.color_variance;
    float information = 0;
    for (int k = 0; k < 3; ++k) information += s.hit.texels.weight[k] / variance[s.hit.texels.texel[k]];
    observation_.push_back({&s.node, s.area, information});
  }
  average_at_nodes(observation_, texels.color_variance);
  for (auto& v : texels.color_variance) v = 1 / v;
  for (auto& o : observation_) o.weight *= o.value;  // area times information
  std::vector<float> plane(nodes);
  for (std::size_t c = 0; c < channels; ++c) {
    for (std::size_t s = 0; s < sample_.size(); ++s) {
      const auto& [texel, weight] = sample_[s].hit.texels;
      const auto& color = old_[sample_[s].hit.face].texels.color;
      observation_[s].value = 0;
      for (int k = 0; k < 3; ++k) observation_[s].value += weight[k] * color[channels * texel[k] + c];
      if (s < nodes) plane[s] = observation_[s].value;
    }
    fit_nodes(observation_, plane);
    for (std::size_t t = 0; t < nodes; ++t) texels.color[channels * t + c] = std::clamp(plane[t], 0.0f, 1.0f);
  }
}

void TexelResampler::read_overlap(ResampledFace& face) const {
  for (const auto& s : sample_) face.overlap.push_back({s.hit.face, s.area});
  std::stable_sort(face.overlap.begin(), face.overlap.end(),
                   [](const FaceOverlap& a, const FaceOverlap& b) { return a.old_face < b.old_face; });
  std::size_t last = 0;
  float area = face.overlap[0].area, excess = area * old_[face.overlap[0].old_face].evidence.excess;
  for (std::size_t k = 1; k < face.overlap.size(); ++k) {
    const FaceOverlap o = face.overlap[k];
    area += o.area;
    excess += o.area * old_[o.old_face].evidence.excess;
    if (o.old_face == face.overlap[last].old_face)
      face.overlap[last].area += o.area;
    else
      face.overlap[++last] = o;
  }
  face.overlap.resize(last + 1);
  face.evidence.excess = excess / area;
}

void share_votes(std::span<const TexturedFace> old_faces, std::span<ResampledFace* const> new_faces) {
  std::vector<float> area(old_faces.size(), 0.0f);
  for (const auto* face : new_faces)
    for (const auto& o : face->overlap) area[o.old_face] += o.area;
  for (auto* face : new_faces) {
    float hits = 0, through = 0;
    for (const auto& o : face->overlap) {
      const FaceEvidence& old = old_faces[o.old_face].evidence;
      hits += o.area / area[o.old_face] * static_cast<float>(old.hits);
      through += o.area / area[o.old_face] * static_cast<float>(old.through);
    }
    face->evidence.hits = saturated(hits);
    face->evidence.through = saturated(through);
  }
}

std::vector<ResampledFace> resample_faces(std::span<const TexturedFace> old_faces,
                                          std::span<const std::array<Eigen::Vector3f, 3>> new_corners,
                                          const PpmSettings& settings) {
  TexelResampler resampler(old_faces, settings);
  std::vector<ResampledFace> faces;
  faces.reserve(new_corners.size());
  for (const auto& corner : new_corners) faces.push_back(resampler.resample(corner));
  std::vector<ResampledFace*> all;
  for (auto& face : faces) all.push_back(&face);
  share_votes(old_faces, all);
  return faces;
}

}  // namespace ppm
