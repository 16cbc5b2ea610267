#include "framework/slam/prediction.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

/// Makes `out` a view of misses with the camera and pose of `view`.
void blank(const Prediction& view, Prediction& out) {
  out.reset(view.camera, 1, view.T_map_camera, view.color_channels);
  out.stride = view.stride;
}

/// The entries of some rows of a view.
std::span<const std::uint32_t> of_rows(const std::vector<std::uint32_t>& pixels, const Camera& camera,
                                       const Rows& rows) {
  const auto cols = static_cast<std::size_t>(camera.cols);
  return std::span(pixels).subspan(static_cast<std::size_t>(rows.first) * cols,
                                   static_cast<std::size_t>(rows.end - rows.first) * cols);
}

}  // namespace

void DeferredView::elements(const Prediction& view, const Rows& rows, std::span<std::uint32_t> chunk,
                            std::span<std::uint32_t> face) const {
  Prediction whole;
  blank(view, whole);
  fill(view, rows, whole);
  whole.elements(rows, chunk, face);
}

void ViewSamples::resize(std::size_t pixels, int channels) {
  range.resize(pixels);
  variance.resize(pixels);
  cosine.resize(pixels);
  color_channels = channels;
  color.resize(static_cast<std::size_t>(channels) * pixels);
  color_variance.resize(channels > 0 ? pixels : 0);
}

void Prediction::reset(const Camera& frame_camera, int stride_, const Pose& T_map_camera_, int channels) {
  camera = frame_camera.decimated(stride_);
  stride = stride_;
  T_map_camera = T_map_camera_;
  deferred.reset();
  const auto n = static_cast<std::size_t>(camera.pixels());
  range.assign(n, kMiss);
  mean.assign(n, 0.0f);
  variance.assign(n, 0.0f);
  normal.assign(3 * n, 0.0f);
  chunk.assign(n, kNone);
  face.assign(n, kNone);
  bary.assign(2 * n, 0.0f);
  color_channels = channels;
  color.assign(static_cast<std::size_t>(channels) * n, 0.0f);
  color_variance.assign(channels > 0 ? n : 0, 0.0f);
}

void Prediction::reset_deferred(const Camera& frame_camera, int stride_, const Pose& T_map_camera_, int channels) {
  camera = frame_camera.decimated(stride_);
  stride = stride_;
  T_map_camera = T_map_camera_;
  deferred.reset();
  for (auto* array : {&range, &mean, &variance, &normal, &color, &color_variance, &bary}) array->clear();
  chunk.clear();
  face.clear();
  color_channels = channels;
}

void Prediction::sample(std::span<const std::uint32_t> pixels, ViewSamples& out) const {
  PPM_CHECK(out.size() == pixels.size(), "{} samples of {} pixels", out.size(), pixels.size());
  if (deferred) return deferred->sample(*this, pixels, out);
  const auto channels = static_cast<std::size_t>(out.color_channels);
  const Eigen::Matrix3f R = T_map_camera.linear().cast<float>();
  const auto cols = static_cast<std::uint32_t>(camera.cols);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t p = pixels[i];
    if (channels > 0) {
      std::copy_n(&color[channels * p], channels, &out.color[channels * i]);
      out.color_variance[i] = color_variance[p];
    }
    out.range[i] = kMiss, out.variance[i] = 0, out.cosine[i] = 1;
    if (!hit(p)) continue;
    const Eigen::Vector3f ray = camera.ray(pixels[i] % cols, pixels[i] / cols).normalized().cast<float>();
    const Eigen::Map<const Eigen::Vector3f> n(&normal[3 * p]);
    const float c = std::max(std::abs(n.dot(R * ray)), static_cast<float>(kMinCosine));
    out.range[i] = range[p] - mean[p] / c;
    out.variance[i] = variance[p] / (c * c);
    out.cosine[i] = c;
  }
}

void Prediction::elements(const Rows& rows, std::span<std::uint32_t> chunk_out,
                          std::span<std::uint32_t> face_out) const {
  if (deferred) return deferred->elements(*this, rows, chunk_out, face_out);
  const auto chunks = of_rows(chunk, camera, rows), faces = of_rows(face, camera, rows);
  PPM_CHECK(chunk_out.size() == chunks.size() && face_out.size() == faces.size(), "{} and {} elements of {} pixels",
            chunk_out.size(), face_out.size(), chunks.size());
  std::copy(chunks.begin(), chunks.end(), chunk_out.begin());
  std::copy(faces.begin(), faces.end(), face_out.begin());
}

Eigen::Vector3d Prediction::direction(std::size_t pixel) const {
  const auto cols = static_cast<std::size_t>(camera.cols);
  const auto ray = camera.ray(static_cast<double>(pixel % cols), static_cast<double>(pixel / cols));
  return T_map_camera.linear() * ray.normalized();
}

double Prediction::cosine(std::size_t pixel, const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d n(normal[3 * pixel], normal[3 * pixel + 1], normal[3 * pixel + 2]);
  return std::max(std::abs(n.dot(direction)), kMinCosine);
}

namespace {

/// Names every member: with one more the compiler stops here, so that none is forgotten.
template <class P, class Do>
void each_member(P& prediction, const Do& act) {
  auto& [camera, stride, T_map_camera, range, mean, variance, normal, chunk, face, color_channels, color,
         color_variance, bary, deferred] = prediction;
  static_cast<void>(deferred);  // completed before it is saved
  act(camera), act(stride), act(T_map_camera), act(range), act(mean), act(variance), act(normal);
  act(chunk), act(face), act(color_channels), act(color), act(color_variance), act(bary);
}

}  // namespace

void save(RecordWriter& out, const Prediction& prediction) {
  if (prediction.deferred) {
    Prediction whole;
    blank(prediction, whole);
    prediction.deferred->fill(prediction, all_rows(prediction.camera), whole);
    return save(out, whole);
  }
  each_member(prediction, [&](const auto& member) { out.add(member); });
}

void load(RecordReader& in, Prediction& prediction) {
  each_member(prediction, [&](auto& member) { in.take(member); });
}

PredictionHandle completed(const PredictionHandle& view, PredictionPool& pool, const Workers& workers) {
  if (!view->deferred) return view;
  auto out = pool.take();
  blank(*view, *out);
  for_each_band(workers, view->camera.rows, kBandRows, [&](const Rows& rows) { view->deferred->fill(*view, rows, *out); });
  return out;
}

}  // namespace ppm
