#include "framework/slam/decimate.hpp"

#include "framework/graph/registry.hpp"
#include "framework/roles/frame_filter.hpp"

namespace {

using namespace ppm;

/// Keeps each n-th pixel of each n-th row, from pixel (0, 0) on. As the source's pixel_stride, but after what looks at
/// neighbours: a flying pixel is seen best in the whole image.
class Decimate final : public Preprocessing {
 public:
  Decimate() { params_.add("stride", stride_).range(1, 64).doc("Keeps each n-th pixel of each n-th row."); }

 protected:
  void apply(Frame& image, const Workers&) const override { image = decimated(image, stride_); }

 private:
  int stride_ = 2;
};

}  // namespace

PPM_MODULES(r) {
  r.add<Decimate>("preprocess.decimate", "Keeps each n-th pixel of each n-th row.",
                  "Common practice; the counterpart of the sources' pixel_stride");
}
