#pragma once
#include "framework/core/parallel.hpp"
#include "framework/graph/module.hpp"
#include "framework/slam/frame.hpp"

namespace ppm {

/// Base of modules that make a frame of another one: `sensor.*` and `preprocess.*`. Nodes below read `NODE.frame`.
/// Where the node does not run, the frame goes through as it is.
class FrameFilter : public Module {
 public:
  In<Frame> frame{this, "frame", "The image to be changed."};
  Out<Frame> changed{this, "frame", "The image as changed.", &frame};

  void tick(Context& context) final;

 protected:
  /// Changes a copy of the node's frame in place. A pure function of the frame and the parameters. Throws DataError
  /// where the frame lacks what it needs. workers: for loops over rows.
  virtual void apply(Frame& image, const Workers& workers) const = 0;
  /// Records metrics of the change.
  virtual void record(Context&, const Frame& /*before*/, const Frame& /*after*/) const {}
};

/// Base of every `sensor.*`: says how far a frame's numbers can be trusted. Held-out frames get the same model (see
/// sensor_models), because the same sensor measured them.
class SensorModel : public FrameFilter {
 public:
  /// Replaces sigma (NaN where depth is) and lateral_px, and nothing else. Called from any thread. Throws DataError
  /// where the frame lacks what the model needs.
  virtual void set_noise(Frame& image) const = 0;

 protected:
  void apply(Frame& image, const Workers&) const final { set_noise(image); }
};

/// Base of every `preprocess.*`: drops pixels (depth and sigma become NaN) or changes depths. Held-out frames are left
/// as measured: a map is not excused from pixels that were kept from it.
///
/// metrics  dropped (share of the pixels with a return)
class Preprocessing : public FrameFilter {
 protected:
  void record(Context& context, const Frame& before, const Frame& after) const override;
};

}  // namespace ppm
