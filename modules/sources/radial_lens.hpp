#pragma once
#include <vector>

namespace ppm {

/// Where a ray meets the image of a lens with radial distortion: column = cx + x (f + a r^2 + b r^4), row likewise with
/// y, for the ray (x, y, 1) and r^2 = x^2 + y^2. Pixels are square. Source: Brown, "Decentering distortion of lenses",
/// Photogrammetric Engineering 32(3), 1966 (radial terms)
struct RadialLens {
  double cx = 0, cy = 0, f = 1, a = 0, b = 0;  // px
  double rms = 0;                              ///< px, of the rays that it was fitted to

  double column(double x, double y) const { return cx + x * scale(x, y); }
  double row(double x, double y) const { return cy + y * scale(x, y); }

 private:
  double scale(double x, double y) const {
    const double r2 = x * x + y * y;
    return f + r2 * (a + r2 * b);
  }
};

/// The rays of some pixels, one entry each.
struct PixelRays {
  std::vector<double> column, row, x, y;
};
/// The lens that fits best (linear least squares). Needs at least 5 rays that are not all alike.
RadialLens fit_radial_lens(const PixelRays& rays);

}  // namespace ppm
