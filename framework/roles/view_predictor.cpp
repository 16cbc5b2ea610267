#include "framework/roles/view_predictor.hpp"

#include <algorithm>
#include <unordered_set>

#include "framework/roles/twins.hpp"

namespace ppm {
namespace {

constexpr int kBandRows = 16;  // a part of a view for one worker

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
  std::vector<const Map*> maps;
  std::unordered_set<const Map*> seen;
  for (const auto& map : particles.map)
    if (seen.insert(map.get()).second) maps.push_back(map.get());
  prepare(maps, context.workers());

  // Views that several particles share are there before the loop; the loop makes each particle's own. Where there are
  // fewer views than would keep the workers busy, all are made here, in parts.
  particles.prediction.assign(particles.size(), nullptr);
  const auto leader = twins(particles, false);
  std::vector<std::size_t> views, shared;
  std::vector<ExpectedView> expected;
  for (std::size_t i = 0; i < leader.size(); ++i) {
    if (leader[i] == i) {
      views.push_back(i);
      expected.push_back({particles.map[i].get(), particles.pose[i]});
    } else {
      shared.push_back(leader[i]);
    }
  }
  expect(frame->camera.decimated(stride_), expected);
  std::sort(shared.begin(), shared.end());
  shared.erase(std::unique(shared.begin(), shared.end()), shared.end());
  const bool few = views.size() < 2 * static_cast<std::size_t>(context.workers().threads());
  predict_in_bands(few ? views : shared, context.workers());
  for (std::size_t i = 0; i < leader.size(); ++i) particles.prediction[i] = particles.prediction[leader[i]];
}

void ViewPredictor::predict_in_bands(const std::vector<std::size_t>& particles, const Workers& workers) {
  std::vector<std::shared_ptr<Prediction>> views(particles.size());
  workers.for_each(views.size(), [&](std::size_t k, int) { views[k] = blank_view(particles[k]); });
  if (views.empty()) return;
  const int rows = views.front()->camera.rows;
  const auto bands = static_cast<std::size_t>((rows + kBandRows - 1) / kBandRows);
  workers.for_each(bands * views.size(), [&](std::size_t i, int worker) {
    const std::size_t k = i / bands;
    const int first = static_cast<int>(i % bands) * kBandRows;
    predict(*belief->map[particles[k]], {first, std::min(first + kBandRows, rows)}, *views[k], worker);
  });
  for (std::size_t k = 0; k < views.size(); ++k) belief->prediction[particles[k]] = std::move(views[k]);
}

void ViewPredictor::tick(Context&, std::size_t particle, int worker) {
  auto& prediction = belief->prediction[particle];
  if (prediction) return;
  auto view = blank_view(particle);
  predict(*belief->map[particle], all_rows(view->camera), *view, worker);
  prediction = std::move(view);
}

std::shared_ptr<Prediction> ViewPredictor::blank_view(std::size_t particle) {
  auto out = pool_.take();
  const Map& map = *belief->map[particle];
  out->reset_deferred(frame->camera, stride_, belief->pose[particle], map.color_channels());
  auto deferred = defer(map, *out);
  if (!deferred) out->reset(frame->camera, stride_, belief->pose[particle], map.color_channels());
  out->deferred = std::move(deferred);
  return out;
}

}  // namespace ppm
