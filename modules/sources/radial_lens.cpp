#include "modules/sources/radial_lens.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace ppm {

RadialLens fit_radial_lens(const PixelRays& rays) {
  using Vector = Eigen::Matrix<double, 5, 1>;
  Eigen::Matrix<double, 5, 5> squares = Eigen::Matrix<double, 5, 5>::Zero();
  Vector right = Vector::Zero();
  auto equation = [&](std::size_t i, bool is_row) {
    const double r2 = rays.x[i] * rays.x[i] + rays.y[i] * rays.y[i], t = is_row ? rays.y[i] : rays.x[i];
    Vector v;
    v << !is_row, is_row, t, t * r2, t * r2 * r2;
    return v;
  };
  for (std::size_t i = 0; i < rays.x.size(); ++i)
    for (const bool is_row : {false, true}) {
      const Vector v = equation(i, is_row);
      squares += v * v.transpose();
      right += v * (is_row ? rays.row[i] : rays.column[i]);
    }
  const Vector s = squares.ldlt().solve(right);
  RadialLens lens{s[0], s[1], s[2], s[3], s[4], 0};
  double sum = 0;
  for (std::size_t i = 0; i < rays.x.size(); ++i)
    sum += std::pow(lens.column(rays.x[i], rays.y[i]) - rays.column[i], 2) +
           std::pow(lens.row(rays.x[i], rays.y[i]) - rays.row[i], 2);
  lens.rms = std::sqrt(sum / static_cast<double>(2 * rays.x.size()));
  return lens;
}

}  // namespace ppm
