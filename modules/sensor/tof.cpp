#include <limits>

#include "framework/graph/registry.hpp"
#include "framework/roles/frame_filter.hpp"
#include "framework/slam/tof_noise.hpp"

namespace {

using namespace ppm;

/// Noise of a time-of-flight camera, from range and, where the frame has it, the amplitude of the light that came back
/// (Frame::confidence). `ppm calibrate sensor` fits the parameters to still images of a camera.
/// sigma       of the depth: TofNoise's of the range, times depth / range
/// lateral_px  a place within the pixel that collected the light: 1 / sqrt(12) by default
/// source      Lange & Seitz 2001; see TofNoise
class Tof final : public SensorModel {
 public:
  Tof() {
    params_.add("sigma_floor", noise_.floor)
        .unit("m")
        .above(0)
        .doc("Noise of the range that stays however much light comes back.");
    params_.add("signal_noise", noise_.signal)
        .range(0, 1e6)
        .doc("With amplitude, the noise is sigma_floor and signal_noise / light, added in squares.");
    params_.add("range_corrected", noise_.range_corrected)
        .doc(
            "Light is amplitude / range^2, for a camera that makes up its amplitudes for the distance (the SR4000 "
            "does); "
            "false: it is the amplitude itself.");
    params_.add("sigma_quadratic", noise_.quadratic)
        .range(0, 1)
        .doc("Without amplitude, the noise is sigma_floor and sigma_quadratic * range^2 (1/m), added in squares.");
    params_.add("sigma_most", noise_.most).unit("m").above(0).doc("No range has more noise than this.");
    params_.add("sigma_lateral", lateral_)
        .unit("px")
        .range(0, 10)
        .doc("Noise across the line of sight, in pixels of this image.");
  }

  void set_noise(Frame& image) const override {
    image.lateral_px = static_cast<float>(lateral_);
    image.sigma.assign(image.depth.size(), std::numeric_limits<float>::quiet_NaN());
    const bool amplitudes = !image.confidence.empty();
    for (int y = 0, i = 0; y < image.camera.rows; ++y)
      for (int x = 0; x < image.camera.cols; ++x, ++i) {
        if (!image.valid(i)) continue;
        const auto p = static_cast<std::size_t>(i);
        const double range_per_depth = image.camera.ray(x, y).norm(), range = image.depth[p] * range_per_depth;
        const double sigma = amplitudes ? noise_.sigma(range, image.confidence[p]) : noise_.sigma(range);
        image.sigma[p] = static_cast<float>(sigma / range_per_depth);
      }
  }

 private:
  TofNoise noise_;
  double lateral_ = 0.29;
};

}  // namespace

PPM_MODULES(r) {
  r.add<Tof>("sensor.tof", "Gives the noise of a time-of-flight camera, from range and amplitude.",
             "Lange & Seitz, IEEE JQE 2001; fitted to an SR4000");
}
