#include "framework/slam/innovation.hpp"

#include <cmath>

namespace ppm {

void Innovation::add(const PixelBlock& pixels) {
  for (std::size_t i = 0; i < pixels.size(); i += kEvery) {
    if (!pixels.hit(i)) continue;
    const double cosine = static_cast<double>(pixels.expected.cosine[i]),
                 across = static_cast<double>(pixels.lateral[i]);
    const double variance = static_cast<double>(pixels.variance[i]) + static_cast<double>(pixels.expected.variance[i]) +
                            across * across * (1 - cosine * cosine) / (cosine * cosine);
    const double residual = static_cast<double>(pixels.residual(i)), square = residual * residual / variance;
    if (!(square <= kGate * kGate)) continue;
    ++count;
    sum += residual / std::sqrt(variance);
    squares += square;
  }
}

}  // namespace ppm
