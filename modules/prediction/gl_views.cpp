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
  for (const PpmMap* map : maps) numbers_[map] = std::make_shared<const FaceNumbers>(*map);
  const GlContext::Current current(context_);
  meshes_->update(maps);
  context_.check();
}

void GlViews::expect(const Camera& camera, std::vector<GlView> views) {
  camera_ = camera;
  expected_ = std::move(views);
  for (GlView& view : expected_) view.numbers = numbers_.at(view.map).get();
  const auto in_batch = static_cast<std::size_t>(options_.views_per_draw);
  batches_.assign((expected_.size() + in_batch - 1) / in_batch, {});
}

ShownFaces GlViews::faces(const PpmMap& map, const Camera& camera, const Pose& T_map_camera) {
  const auto known = numbers_.find(&map);
  PPM_CHECK(known != numbers_.end(), "a map is looked at that was not prepared");
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find_if(expected_, [&](const GlView& v) {
    return v.map == &map && camera == camera_ && v.T_map_camera.matrix() == T_map_camera.matrix();
  });
  if (found == expected_.end()) {
    const GlView alone{&map, known->second.get(), T_map_camera};
    const auto drawn = draw(camera, {&alone, 1});
    return {known->second, drawn, *drawn};
  }
  const auto i = static_cast<std::size_t>(found - expected_.begin());
  const auto in_batch = static_cast<std::size_t>(options_.views_per_draw), first = i / in_batch * in_batch;
  Batch& batch = batches_[i / in_batch];
  if (!batch.drawn) {
    const auto views = std::span(expected_).subspan(first, std::min(in_batch, expected_.size() - first));
    batch = {draw(camera, views), views.size()};
  }
  const auto pixels = static_cast<std::size_t>(camera.pixels());
  const ShownFaces shown{known->second, batch.drawn, std::span(*batch.drawn).subspan((i - first) * pixels, pixels)};
  if (--batch.views_left == 0) batch.drawn.reset();
  return shown;
}

std::shared_ptr<const GlViews::Numbers> GlViews::draw(const Camera& camera, std::span<const GlView> views) {
  auto numbers = pool_.take();
  numbers->resize(views.size() * static_cast<std::size_t>(camera.pixels()));
  const GlContext::Current current(context_);
  rasterizer_->draw(camera, views, *meshes_, *numbers);
  return numbers;
}

}  // namespace ppm
