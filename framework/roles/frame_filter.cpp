#include "framework/roles/frame_filter.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace ppm {

void FrameFilter::tick(Context& context) {
  auto image = std::make_shared<Frame>(*frame);
  apply(*image, context.workers());
  record(context, *frame, *image);
  changed.set(std::move(image));
}

void Preprocessing::record(Context& context, const Frame& before, const Frame& after) const {
  auto returns = [](const Frame& f) {
    return static_cast<double>(std::ranges::count_if(f.depth, [](float z) { return !std::isnan(z); }));
  };
  const double n = returns(before);
  context.metric("dropped", n > 0 ? 1 - returns(after) / n : 0);
}

}  // namespace ppm
