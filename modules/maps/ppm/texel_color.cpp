#include "modules/maps/ppm/texel_color.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

/// Fuses a measured colour into a texel's; the channels share one gain, as they share their variance.
void fuse_color(const ColorView& colors, const float* measured, float measured_variance, float* color,
                float& variance) {
  const float prior = std::min(variance + colors.drift_variance(), kColorPriorVariance);
  const float gain = prior / (prior + measured_variance);
  for (int c = 0; c < colors.channels(); ++c) color[c] += gain * (measured[c] - color[c]);
  variance = (1 - gain) * prior;
}

/// One face in the gather form.
class ColorGatherer {
 public:
  ColorGatherer(const UpdateView& view, const ColorView& colors, const TexelSettings& settings,
                const std::array<Eigen::Vector3f, 3>& corner, std::uint32_t divisions, float excess)
      : view_(view), colors_(colors), settings_(settings), corner_(corner), excess_(excess) {
    e1_ = corner[1] - corner[0];
    e2_ = corner[2] - corner[0];
    const Eigen::Vector3f cross = e1_.cross(e2_);
    const float twice_area = cross.norm();
    const auto n = static_cast<float>(divisions);
    normal_ = cross / twice_area;
    offset_ = normal_.dot(corner[0]);
    texel_area_ = twice_area / (n * n);
  }
  bool is_seen_from_behind() const { return offset_ >= 0; }

  void take(float u, float v, float mean, float variance, float* color, float& color_variance) const {
    const Eigen::Vector3f node = corner_[0] + e1_ * u + e2_ * v + normal_ * mean;
    const Eigen::Vector3f image = view_.project(node);
    if (!(image.z() > 0) || image.x() < 0 || image.y() < 0 || image.x() > static_cast<float>(view_.cols() - 1) ||
        image.y() > static_cast<float>(view_.rows() - 1))
      return;
    const auto nearest = view_.at(static_cast<int>(image.x() + 0.5f), static_cast<int>(image.y() + 0.5f));
    if (!view_.measured(nearest)) return;
    const float cosine = std::max(UpdateView::facing(normal_, node), settings_.gate.least_cosine);
    const float limit = settings_.gate_sigmas * settings_.gate.spread(view_.sigma[nearest], cosine, variance + excess_);
    ColorValue seen{};
    if (!interpolate(image.x(), image.y(), offset_ + mean, limit, seen)) return;
    const float pixel = image.z() * view_.inv_fx;
    const float share = std::min(1.0f, texel_area_ * cosine / (pixel * pixel));
    fuse_color(colors_, seen.data(), colors_.variance() / share, color, color_variance);
  }

 private:
  /// Colours of the four pixels around (x, y), weighted bilinearly, of those whose point is within `limit` of the
  /// surface at `offset` along the normal; false where less than half of the weight is left.
  bool interpolate(float x, float y, float offset, float limit, ColorValue& seen) const {
    const int x0 = std::clamp(static_cast<int>(x), 0, view_.cols() - 2);
    const int y0 = std::clamp(static_cast<int>(y), 0, view_.rows() - 2);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const std::array<float, 4> weight{(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
    float total = 0;
    for (int k = 0; k < 4; ++k) {
      const auto p = view_.at(x0 + (k & 1), y0 + (k >> 1));
      if (!(std::abs(normal_.dot(view_.point[p]) - offset) <= limit)) continue;  // also where nothing was measured
      const float w = weight[static_cast<std::size_t>(k)];
      total += w;
      const float* color = colors_.at(p);
      for (std::size_t c = 0; c < static_cast<std::size_t>(colors_.channels()); ++c) seen[c] += w * color[c];
    }
    for (float& value : seen) value /= total;
    return total >= 0.5f;
  }

  const UpdateView& view_;
  const ColorView& colors_;
  const TexelSettings& settings_;
  const std::array<Eigen::Vector3f, 3>& corner_;
  float excess_;
  Eigen::Vector3f e1_, e2_, normal_;
  float offset_, texel_area_;
};

/// The scatter form: the pixel's colour goes to the texel nearest to its hit.
void scatter_color(const UpdateView& view, const ColorView& colors, const TexelSettings& settings, std::size_t p,
                   PpmEdit& edit) {
  const Prediction& seen = *view.prediction;
  const auto& geometry = *edit.map().table()[seen.chunk[p]].geometry;
  const auto f = seen.face[p];
  const Eigen::Vector3f normal = geometry.face_normal(f);
  const float facing = UpdateView::facing(normal, view.point[p]);
  if (facing <= 0) return;
  const std::size_t t =
      geometry.first_texel[f] + nearest_texel(geometry.divisions[f], seen.bary[2 * p], seen.bary[2 * p + 1]);
  Texels& texels = edit.texels(seen.chunk[p]);
  const float off = normal.dot(view.point[p] - view.relative(geometry.position[geometry.face[f][0]])) - texels.mean[t];
  const float cosine = std::max(facing, settings.gate.least_cosine);
  const float variance = texels.variance[t] + texels.evidence[f].added_variance();
  if (std::abs(off) > settings.gate_sigmas * settings.gate.spread(view.sigma[p], cosine, variance)) return;
  fuse_color(colors, colors.at(p), colors.variance(), &texels.color[static_cast<std::size_t>(colors.channels()) * t],
             texels.color_variance[t]);
}

ColorGain compare(const Frame& frame, const Prediction& seen, const std::vector<std::uint8_t>& classes, int channels) {
  ColorGain gain(channels);
  const auto n = static_cast<std::size_t>(channels);
  const auto cols = static_cast<std::size_t>(seen.camera.cols), stride = static_cast<std::size_t>(seen.stride);
  for (std::size_t p = 0; p < classes.size(); ++p) {
    if (!(classes[p] & kOwnHit) || seen.color_variance[p] > 0.1f * kColorPriorVariance) continue;
    ColorValue expected{};
    std::copy_n(&seen.color[n * p], n, expected.begin());
    const auto source = p / cols * stride * static_cast<std::size_t>(frame.camera.cols) + p % cols * stride;
    gain.add(color_of(frame, source, channels), expected);
  }
  return gain;
}

}  // namespace

ColorView::ColorView(const Frame& frame, const UpdateView& view, const std::vector<std::uint8_t>& classes, int channels,
                     const ColorSettings& settings)
    : channels_(channels), variance_(frame.color_sigma * frame.color_sigma), drift_(settings.drift * settings.drift) {
  if (channels == 0) return;
  if (frame.color.empty())
    throw DataError("the source", frame.index, "gives no colour, but the map has; set `color: true` at the source");
  const Prediction& seen = *view.prediction;
  PPM_CHECK(seen.color_channels == channels, "a prediction with {} channels of colour, a map with {}",
            seen.color_channels, channels);
  if (settings.exposure == ColorExposure::gain) gain_ = compare(frame, seen, classes, channels).estimate();
  const auto n = static_cast<std::size_t>(channels);
  value_.resize(n * view.depth.size());
  for (int y = 0; y < view.rows(); ++y)
    for (int x = 0; x < view.cols(); ++x) {
      const auto source = static_cast<std::size_t>(seen.stride * (y * frame.camera.cols + x));
      const ColorValue color = color_of(frame, source, channels);
      for (std::size_t c = 0; c < n; ++c) value_[n * view.at(x, y) + c] = color[c] / gain_[c];
    }
}

void gather_color(const UpdateView& view, const ColorView& colors, const TexelSettings& settings,
                  const std::array<Eigen::Vector3f, 3>& corner, std::uint32_t divisions, float excess,
                  const ColorTexels& texels) {
  const ColorGatherer gatherer(view, colors, settings, corner, divisions, excess);
  if (gatherer.is_seen_from_behind()) return;
  const auto n = static_cast<float>(divisions);
  const auto channels = static_cast<std::size_t>(colors.channels());
  std::size_t t = 0;
  for (std::uint32_t i = 0; i <= divisions; ++i)
    for (std::uint32_t j = 0; i + j <= divisions; ++j, ++t)
      gatherer.take(static_cast<float>(i) / n, static_cast<float>(j) / n, texels.mean[t], texels.variance[t],
                    &texels.color[channels * t], texels.color_variance[t]);
}

namespace {

void gather_map_face(const UpdateView& view, const ColorView& colors, const TexelSettings& settings,
                     const Geometry& geometry, std::uint32_t f, Texels& texels) {
  const std::size_t n = texels.channels(), first = geometry.first_texel[f], count = texel_count(geometry.divisions[f]);
  gather_color(view, colors, settings, corners_in(view, geometry, f), geometry.divisions[f],
               texels.evidence[f].added_variance(),
               {{&texels.mean[first], count},
                {&texels.variance[first], count},
                {&texels.color[n * first], n * count},
                {&texels.color_variance[first], count}});
}

}  // namespace

void start_color(const UpdateView& view, const ColorView& colors, const TexelSettings& settings,
                 const std::array<Eigen::Vector3f, 3>& corner, std::uint32_t divisions, float excess,
                 const ColorTexels& texels) {
  std::fill(texels.color.begin(), texels.color.end(), kColorPriorMean);
  std::fill(texels.color_variance.begin(), texels.color_variance.end(), kColorPriorVariance);
  gather_color(view, colors, settings, corner, divisions, excess, texels);
}

void update_color(const UpdateView& view, const ColorView& colors, const std::vector<std::uint8_t>& classes,
                  const std::vector<FaceRef>& faces, const TexelSettings& settings, const Workers& workers,
                  PpmEdit& edit) {
  if (colors.empty()) return;
  if (settings.form == TexelForm::scatter) {
    for (std::size_t p = 0; p < classes.size(); ++p)
      if (classes[p] & kOwnHit) scatter_color(view, colors, settings, p, edit);
    return;
  }
  for_each_face(faces, workers, edit, [&](const Geometry& geometry, std::uint32_t face, Texels& texels) {
    gather_map_face(view, colors, settings, geometry, face, texels);
  });
}

}  // namespace ppm
