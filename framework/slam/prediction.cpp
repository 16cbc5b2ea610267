#include "framework/slam/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ppm {

void Prediction::reset(const Camera& frame_camera, int stride_, const Pose& T_map_camera_, int channels) {
  camera = frame_camera.decimated(stride_);
  stride = stride_;
  T_map_camera = T_map_camera_;
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
         color_variance, bary] = prediction;
  act(camera), act(stride), act(T_map_camera), act(range), act(mean), act(variance), act(normal);
  act(chunk), act(face), act(color_channels), act(color), act(color_variance), act(bary);
}

}  // namespace

void save(RecordWriter& out, const Prediction& prediction) {
  each_member(prediction, [&](const auto& member) { out.add(member); });
}

void load(RecordReader& in, Prediction& prediction) {
  each_member(prediction, [&](auto& member) { in.take(member); });
}

std::shared_ptr<Prediction> PredictionPool::take() {
  std::unique_ptr<Prediction> prediction;
  {
    std::lock_guard lock(store_->mutex);
    if (!store_->free.empty()) {
      prediction = std::move(store_->free.back());
      store_->free.pop_back();
    }
  }
  if (!prediction) prediction = std::make_unique<Prediction>();
  auto give_back = [store = store_](Prediction* used) {
    std::unique_ptr<Prediction> owned(used);
    std::lock_guard lock(store->mutex);
    store->free.push_back(std::move(owned));
  };
  return {prediction.release(), std::move(give_back)};
}

}  // namespace ppm
