#include "framework/roles/view_predictor.hpp"

#include <algorithm>

#include "framework/roles/twins.hpp"

namespace ppm {
namespace {

// Rows of the parts that views are cut into: as few parts as keep the workers busy, since each starts anew in the map.
int rows_of_band(int rows, std::size_t views, int threads) {
  constexpr int kLeast = 16;
  const auto wanted = threads > 1 ? 4 * static_cast<std::size_t>(threads) : 1;
  const auto parts = static_cast<int>((wanted + views - 1) / views);
  return std::max((rows + parts - 1) / parts, kLeast);
}

std::vector<std::string> what_is_given(ViewPredictor::Views views) {
  std::vector<std::string> facets{"prediction"};
  if (views == ViewPredictor::Views::exact) facets.push_back("prediction.elements");
  return facets;
}

}  // namespace

ViewPredictor::ViewPredictor(const std::string& map_facet, Views views)
    : belief(this, {{map_facet}, what_is_given(views), {}}) {
  params_.add("stride", stride_).range(1, 64).doc("Predicts each n-th pixel of each n-th row of the frame.");
}

void ViewPredictor::expect(const Camera&, const std::vector<ExpectedView>&) {}

void ViewPredictor::give(const Camera&, const std::vector<std::size_t>&, Context&) {}

std::shared_ptr<DeferredView> ViewPredictor::defer(const Map&, const Prediction&) const {
  return nullptr;
}

void ViewPredictor::predict_all(const Map& map, Prediction& out, int worker) const {
  const Rows rows = all_rows(out.camera);
  out.deferred = defer(map, out);
  predict(map, rows, out, worker);
  if (!out.deferred) return;
  out.deferred->fill(out, rows, out);
  out.deferred.reset();
}

void ViewPredictor::before(Context& context) {
  auto& particles = *belief;
  prepare(distinct_maps(particles), context.workers());

  // Views that several particles share are there before the loop; the loop makes each particle's own. Where there are
  // fewer views than would keep the workers busy, all are made here, in parts.
  particles.prediction.assign(particles.size(), nullptr);
  const auto leader = twins(particles, false);
  std::vector<std::size_t> views, shared;
  for (std::size_t i = 0; i < leader.size(); ++i) (leader[i] == i ? views : shared).push_back(leader[i]);
  give(frame->camera.decimated(stride_), views, context);
  std::erase_if(views, [&](std::size_t i) { return particles.prediction[i] != nullptr; });
  std::erase_if(shared, [&](std::size_t i) { return particles.prediction[i] != nullptr; });
  std::sort(shared.begin(), shared.end());
  shared.erase(std::unique(shared.begin(), shared.end()), shared.end());

  auto views_of = [&](const std::vector<std::size_t>& of) {
    std::vector<ExpectedView> expected;
    for (auto i : of) expected.push_back({particles.map[i].get(), particles.pose[i]});
    return expected;
  };
  expect(frame->camera.decimated(stride_), views_of(views));
  const bool few = views.size() < 2 * static_cast<std::size_t>(context.workers().threads());
  const auto& now = few ? views : shared;
  auto made = predict_in_bands(frame->camera, stride_, views_of(now), context.workers());
  for (std::size_t k = 0; k < now.size(); ++k) particles.prediction[now[k]] = std::move(made[k]);
  for (std::size_t i = 0; i < leader.size(); ++i) particles.prediction[i] = particles.prediction[leader[i]];
}

std::vector<std::shared_ptr<Prediction>> ViewPredictor::predict_in_bands(const Camera& camera, int stride,
                                                                         const std::vector<ExpectedView>& views,
                                                                         const Workers& workers) {
  std::vector<std::shared_ptr<Prediction>> made(views.size());
  workers.for_each(views.size(), [&](std::size_t k, int) { made[k] = blank_view(camera, stride, views[k]); });
  if (views.empty()) return made;
  const int rows = made.front()->camera.rows;
  const int band = rows_of_band(rows, views.size(), workers.threads());
  const auto bands = static_cast<std::size_t>((rows + band - 1) / band);
  workers.for_each(bands * views.size(), [&](std::size_t i, int worker) {
    const std::size_t k = i / bands;
    const int first = static_cast<int>(i % bands) * band;
    predict(*views[k].map, {first, std::min(first + band, rows)}, *made[k], worker);
  });
  return made;
}

void ViewPredictor::tick(Context&, std::size_t particle, int worker) {
  auto& prediction = belief->prediction[particle];
  if (prediction) return;
  const Map& map = *belief->map[particle];
  auto view = blank_view(frame->camera, stride_, {&map, belief->pose[particle]});
  predict(map, all_rows(view->camera), *view, worker);
  prediction = std::move(view);
}

std::shared_ptr<Prediction> ViewPredictor::blank_view(const Camera& camera, int stride, const ExpectedView& view) {
  auto out = pool_.take();
  const int channels = view.map->color_channels();
  out->reset_deferred(camera, stride, view.T_map_camera, channels);
  auto deferred = defer(*view.map, *out);
  if (!deferred) out->reset(camera, stride, view.T_map_camera, channels);
  out->deferred = std::move(deferred);
  return out;
}

}  // namespace ppm
