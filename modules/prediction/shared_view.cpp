#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "framework/graph/registry.hpp"
#include "framework/roles/view_predictor.hpp"
#include "modules/prediction/mesh_view.hpp"
#include "modules/prediction/raster_drawing.hpp"
#include "modules/prediction/view_groups.hpp"
#include "modules/prediction/warped_view.hpp"

namespace {

using namespace ppm;

/// Predicts views of mesh maps that many particles share: one view is drawn between particles that stand close together
/// (as prediction.raster draws it, with a margin around the image), and each particle's pixels are carried over to it. A
/// ray is followed to the pixel of the shared view where its point appears, by the inverse depth found in the ray's
/// direction; then it meets the plane of the surface there. Texel mean and variance, and colour, are those of that
/// pixel. So a particle sees the surface where it is from its own pose; what is lost is what only it sees:
///   - behind a depth jump, what the shared view hides is not known: the ray meets one of the planes on either side
///   - an element that is seen so flat that its plane would be carried beyond twice or half the depth is taken at the
///     depth of the shared view's pixel
///   - beyond the margin (a quarter of the image at most), the elements at its border are carried on
///
/// Particles farther from the shared pose than the limits, or with fewer around them than group_least, are given views
/// of their own, which are exact.
///
/// prediction  as of prediction.raster, approximate: maps are not to be updated from it
///
/// metrics     groups (shared views), shared, own (different views of particles that are weighed against one of those,
///             and that are drawn for themselves)
///
/// source      McMillan and Bishop, "Plenoptic Modeling: An Image-Based Rendering System", SIGGRAPH 1995 (warping an image
///             with depth); paper, section 5
class SharedViewPredictor final : public ViewPredictor {
 public:
  SharedViewPredictor() : ViewPredictor("map.ppm", Views::approximate) {
    params_.add("distance_most", limits_.distance_m)
        .unit("m")
        .range(0, 1)
        .doc("Largest distance of a particle from the pose of the view that it shares.");
    params_.add("angle_most", limits_.angle_rad)
        .unit("rad")
        .range(0, 0.5)
        .doc("Largest rotation of a particle from the pose of the view that it shares.");
    params_.add("group_least", group_least_)
        .range(1, 1e6)
        .doc("Fewer different views of one map close together are drawn one by one.");
    params_.add("detail", detail_)
        .range(0.25, 4)
        .doc("Pixels of a shared view along one pixel of the frame's: more find edges more exactly.");
    declare_mesh_view(params_, options_.cull_back_faces, options_.linear_texels);
  }

  void prepare(const std::vector<const Map*>&, const Workers& workers) override { drawer_.prepare(workers); }

  std::shared_ptr<DeferredView> defer(const Map& map, const Prediction& out) const override {
    return drawer_.start(as_ppm(map), out, options_);
  }

  void predict(const Map&, const Rows& rows, Prediction& out, int worker) const override {
    drawer_.draw(rows, out, worker);
  }

  void give(const Camera& camera, const std::vector<std::size_t>& particles, Context& context) override {
    std::vector<ExpectedView> views;
    for (auto i : particles) views.push_back({belief->map[i].get(), belief->pose[i]});
    limits_.least = static_cast<std::size_t>(group_least_);
    const auto groups = group_views(views, limits_);
    const auto planes = shared_views(with_margin(camera, groups, views), groups, views, context.workers());
    std::size_t shared = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const auto& members = groups[g].members;
      shared += members.size();
      context.workers().for_each(members.size(), [&](std::size_t k, int) {
        const std::size_t i = particles[members[k]];
        belief->prediction[i] = warped(planes[g], belief->pose[i]);
      });
    }
    context.metric("groups", static_cast<double>(groups.size()));
    context.metric("shared", static_cast<double>(shared));
    context.metric("own", static_cast<double>(views.size() - shared));
  }

 private:
  PredictionHandle warped(const std::shared_ptr<const PlaneView>& planes, const Pose& pose) const {
    auto out = std::make_shared<Prediction>();  // small: not from a pool, where it would hold on to the planes
    out->reset_deferred(frame->camera, stride(), pose, planes->view().color_channels);
    out->deferred = std::make_shared<WarpedView>(planes, *out);
    return out;
  }

  std::vector<std::shared_ptr<const PlaneView>> shared_views(const Camera& camera, const std::vector<ViewGroup>& groups,
                                                             const std::vector<ExpectedView>& views,
                                                             const Workers& workers) {
    std::vector<ExpectedView> wanted;
    for (const auto& group : groups) wanted.push_back({views[group.members.front()].map, group.pose});
    auto drawn = predict_in_bands(camera, 1, wanted, workers);
    std::vector<std::shared_ptr<const PlaneView>> made;
    for (std::size_t g = 0; g < drawn.size(); ++g) {
      auto planes = planes_.take();
      planes->start(as_ppm(*wanted[g].map), std::move(drawn[g]));
      for_each_band(workers, camera.rows, kBandRows, [&](const Rows& rows) { planes->fill(rows); });
      made.push_back(std::move(planes));
    }
    return made;
  }

  /// The camera with as many pixels more on every side as the members of the groups may see beyond it.
  Camera with_margin(const Camera& camera, const std::vector<ViewGroup>& groups,
                     const std::vector<ExpectedView>& views) const {
    const double near_m = nearest_depth();
    Eigen::Vector2d most = Eigen::Vector2d::Zero();
    for (const auto& group : groups)
      for (auto k : group.members)
        most = most.cwiseMax(WarpedView::overhang(camera, group.pose.inverse() * views[k].T_map_camera, near_m));
    const int x = std::min(static_cast<int>(std::ceil(most.x())), camera.cols / 4);
    const int y = std::min(static_cast<int>(std::ceil(most.y())), camera.rows / 4);
    auto pixels = [&](int n) { return static_cast<int>(std::ceil(detail_ * n)); };
    return {pixels(camera.cols + 2 * x), pixels(camera.rows + 2 * y),
            detail_ * camera.fx, detail_ * camera.fy,
            detail_ * (camera.cx + x + 0.5) - 0.5, detail_ * (camera.cy + y + 0.5) - 0.5};
  }

  /// m: all but a hundredth of what the frame measures, by some of its pixels, is farther away.
  double nearest_depth() const {
    constexpr std::size_t kLooks = 4096;
    std::vector<float> depth;
    for (std::size_t p = 0; p < frame->depth.size(); p += 1 + frame->depth.size() / kLooks)
      if (frame->depth[p] > 0) depth.push_back(frame->depth[p]);
    if (depth.empty()) return 1;
    const auto nearest = depth.begin() + static_cast<std::ptrdiff_t>(depth.size() / 100);
    std::nth_element(depth.begin(), nearest, depth.end());
    return static_cast<double>(*nearest);
  }

  GroupLimits limits_{0.1, 4 * EIGEN_PI / 180};
  int group_least_ = 6;
  double detail_ = 1;
  RasterOptions options_;
  mutable RasterDrawer drawer_;
  Pool<PlaneView> planes_;
};

}  // namespace

PPM_MODULES(r) {
  r.add<SharedViewPredictor>(
      "prediction.shared_view",
      "About what each particle should see of its mesh map, by one view between particles that are close together.",
      "McMillan and Bishop, Plenoptic Modeling, SIGGRAPH 1995; paper, section 5");
}
