#include <array>
#include <limits>

#include "framework/graph/registry.hpp"
#include "framework/roles/frame_filter.hpp"
#include "modules/preprocess/depth_jumps.hpp"
#include "modules/preprocess/row_bands.hpp"

namespace {

using namespace ppm;

/// Which pixels beside a depth jump go, besides those that fly.
enum class Edge { none, near, far, both };

/// Drops flying pixels: those that measured a mixture of two surfaces, and so a place where nothing is. A pixel flies
/// where the depth jumps on both its sides, along the row or the column, in one sense (near surface, pixel, far
/// surface); or where none of its four neighbours lies on one surface with it. With `edge`, pixels beside any jump go
/// too. frame   sigma is read: differences within the noise are no jumps source  May et al., Journal of Field Robotics
/// 2009 (what a jump is); comparing both sides keeps the edge of a thing, which
///         has a jump on one side only
class FlyingPixels final : public Preprocessing {
 public:
  FlyingPixels() {
    params_.add("angle_least", jumps_.angle_least)
        .unit("rad")
        .range(0, 1.5)
        .doc(
            "Depth jumps between two pixels where the line through their points makes a smaller angle with the line of "
            "sight.");
    params_.add("noise_sigmas", jumps_.noise_sigmas)
        .range(0, 100)
        .doc("Depths that differ by less than so many standard deviations do not jump.");
    params_
        .add_choice("edge", edge_,
                    {{"none", Edge::none}, {"near", Edge::near}, {"far", Edge::far}, {"both", Edge::both}})
        .doc(
            "Which pixels beside a jump are dropped too: those before it, behind it, or both (the form of May et "
            "al.).");
  }

 protected:
  void apply(Frame& image, const Workers& workers) const override {
    const DepthJumps jumps = depth_jumps(image, jumps_, workers);
    const int cols = image.camera.cols;
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    for_row_bands(workers, image.camera.rows, cols, [&](int first, int last) {
      for (int y = first; y < last; ++y)
        for (int x = 0; x < cols; ++x) {
          const auto p = static_cast<std::size_t>(y * cols + x);
          const Around steps = around(jumps, cols, x, y);
          if (one_surface(steps) || !(image.depth[p] == image.depth[p])) continue;
          if (drops(steps)) image.depth[p] = image.sigma[p] = nan;
        }
    });
  }

 private:
  /// From a pixel to those on its left, right, above and below.
  using Around = std::array<Step, 4>;

  static Step reversed(Step s) { return s == Step::closer ? Step::farther : s == Step::farther ? Step::closer : s; }
  static Around around(const DepthJumps& jumps, int cols, int x, int y) {
    const auto p = static_cast<std::size_t>(y * cols + x);
    return {x > 0 ? reversed(jumps.right[p - 1]) : Step::unknown, jumps.right[p],
            y > 0 ? reversed(jumps.down[p - static_cast<std::size_t>(cols)]) : Step::unknown, jumps.down[p]};
  }
  /// Whether nothing is to be decided: so it is nearly everywhere.
  static bool one_surface(const Around& steps) {
    return steps == Around{Step::none, Step::none, Step::none, Step::none};
  }
  static bool is_jump(Step s) { return s == Step::closer || s == Step::farther; }

  bool drops(const Around& steps) const {
    bool attached = false, before = false, behind = false;
    for (Step s : steps) {
      attached |= s == Step::none;
      before |= s == Step::farther;
      behind |= s == Step::closer;
    }
    if (!attached) return true;
    if (is_jump(steps[0]) && steps[1] == reversed(steps[0])) return true;
    if (is_jump(steps[2]) && steps[3] == reversed(steps[2])) return true;
    return (before && (edge_ == Edge::near || edge_ == Edge::both)) ||
           (behind && (edge_ == Edge::far || edge_ == Edge::both));
  }

  JumpSettings jumps_;
  Edge edge_ = Edge::none;
};

}  // namespace

PPM_MODULES(r) {
  r.add<FlyingPixels>("preprocess.flying_pixels", "Drops pixels that mix a near and a far surface at a depth jump.",
                      "May et al., Journal of Field Robotics 26(11), 2009");
}
