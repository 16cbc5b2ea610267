#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/graph/particle_module.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/prediction.hpp"

namespace ppm {

class ViewPredictor;
template <>
struct PortType<ViewPredictor> {
  static constexpr std::string_view name = "prediction.*";
};

/// What each particle should see: the base of every `prediction.*`. Fills the belief's prediction column. Particles
/// with the same map at the same pose share one Prediction. Draws no random numbers.
class ViewPredictor : public ParticleModule {
 public:
  In<Frame> frame{this, "frame", "Gives the camera whose view is predicted."};
  InOut<Belief> belief;

  /// Whether a view shows what the particle's own camera sees, which a map may be updated from, or about that.
  enum class Views { exact, approximate };

  /// Work shared by all views of one map before they are predicted (acceleration structures). The maps are distinct, in
  /// the order of the first particle that has each. Called from one thread.
  virtual void prepare(const std::vector<const Map*>& maps, const Workers& workers) = 0;
  /// A view that is to be predicted.
  struct ExpectedView {
    const Map* map = nullptr;
    Pose T_map_camera = Pose::Identity();
  };
  /// Sets the predictions of some particles otherwise than by predict(); those that are left are predicted. particles:
  /// one of each that share map and pose. camera: of their predictions. After prepare(), from one thread.
  virtual void give(const Camera& camera, const std::vector<std::size_t>& particles, Context& context);
  /// The views that the loop over particles is going to ask for, each once, for back-ends that draw many together;
  /// others may be asked for all the same. camera: of all of them. After prepare(), from one thread.
  virtual void expect(const Camera& camera, const std::vector<ExpectedView>& views);
  /// The back-end's own view, to be filled by predict(), or null where it fills the arrays of the Prediction. out: has
  /// camera, pose and colour channels. Called from any worker.
  virtual std::shared_ptr<DeferredView> defer(const Map& map, const Prediction& out) const;
  /// Predicts some rows of the view of `map` for out.camera at out.T_map_camera; `out` was reset to misses, or holds
  /// what defer() gave. Called from any worker, for other rows of the same view at the same time.
  virtual void predict(const Map& map, const Rows& rows, Prediction& out, int worker) const = 0;
  /// Predicts a whole view with its arrays filled. out: reset to misses.
  void predict_all(const Map& map, Prediction& out, int worker) const;

  void before(Context& context) override;
  using ParticleModule::tick;
  void tick(Context& context, std::size_t particle, int worker) override;
  /// before() reads poses and maps.
  bool starts_loop() const override { return true; }
  const ParticleSet& particles() const override { return *belief; }

 protected:
  /// map_facet: the kind of map that it can look at, "map.ppm".
  explicit ViewPredictor(const std::string& map_facet, Views views = Views::exact);

  /// Views for one camera, each predicted in bands of rows by all workers. For give().
  std::vector<std::shared_ptr<Prediction>> predict_in_bands(const Camera& camera, int stride,
                                                            const std::vector<ExpectedView>& views,
                                                            const Workers& workers);
  int stride() const { return stride_; }

 private:
  std::shared_ptr<Prediction> blank_view(const Camera& camera, int stride, const ExpectedView& view);

  int stride_ = 1;
  PredictionPool pool_;
};

}  // namespace ppm
