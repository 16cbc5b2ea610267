#include "modules/prediction/gl_views.hpp"

#include <algorithm>

#include "framework/core/error.hpp"

namespace ppm {

GlViews::GlViews(const GlViewOptions& options) : options_(options), context_(options.device) {
  const GlContext::Current current(context_);
  meshes_ = std::make_unique<GlMeshes>(context_.gl());
  rasterizer_ = std::make_unique<GlRasterizer>(context_, options.cull_back_faces);
}

GlViews::~GlViews() {
  const GlContext::Current current(context_);
  rasterizer_.reset();
  meshes_.reset();
}

void GlViews::update(const std::vector<const PpmMap*>& maps) {
  numbers_.clear();
  expected_.clear();
  batches_.clear();
  for (const PpmMap* map : maps) numbers_.try_emplace(map, *map);
  const GlContext::Current current(context_);
  meshes_->update(maps);
  context_.check();
}

void GlViews::expect(const Camera& camera, std::vector<GlView> views) {
  camera_ = camera;
  expected_ = std::move(views);
  for (GlView& view : expected_) view.numbers = &numbers_.at(view.map);
  const auto in_batch = static_cast<std::size_t>(options_.views_per_draw);
  batches_.assign((expected_.size() + in_batch - 1) / in_batch, {});
}

SeenFaces GlViews::faces(const PpmMap& map, const Camera& camera, const Pose& T_map_camera, const Rows& rows) {
  const auto known = numbers_.find(&map);
  PPM_CHECK(known != numbers_.end(), "a map is looked at that was not prepared");
  const FaceNumbers* numbers = &known->second;
  const auto pixels = static_cast<std::size_t>(camera.pixels());
  const std::lock_guard lock(mutex_);
  const auto found = camera == camera_ ? std::ranges::find_if(expected_, [&](const GlView& v) {
    return v.map == &map && v.T_map_camera.matrix() == T_map_camera.matrix();
  }) : expected_.end();
  if (found == expected_.end()) {
    const GlView alone{&map, numbers, T_map_camera};
    const auto drawn = draw(camera, {&alone, 1});
    return {drawn, *drawn, numbers};
  }
  const auto i = static_cast<std::size_t>(found - expected_.begin());
  const auto in_batch = static_cast<std::size_t>(options_.views_per_draw), first = i / in_batch * in_batch;
  Batch& batch = batches_[i / in_batch];
  if (!batch.drawn) {
    const auto views = std::span(expected_).subspan(first, std::min(in_batch, expected_.size() - first));
    batch.drawn = draw(camera, views);
    batch.rows_left = camera.rows * static_cast<int>(views.size());
  }
  SeenFaces seen{batch.drawn, std::span(*batch.drawn).subspan((i - first) * pixels, pixels), numbers};
  batch.rows_left -= rows.end - rows.first;
  if (batch.rows_left <= 0) batch.drawn.reset();
  return seen;
}

std::shared_ptr<const GlViews::Numbers> GlViews::draw(const Camera& camera, std::span<const GlView> views) {
  auto numbers = pool_.take();
  numbers->resize(views.size() * static_cast<std::size_t>(camera.pixels()));
  const GlContext::Current current(context_);
  rasterizer_->draw(camera, views, *meshes_, *numbers);
  return numbers;
}

}  // namespace ppm
