#include "framework/slam/tof_noise_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

constexpr double kRangeWidth = 1.2, kAmplitudeWidth = 1.3;  // of a bin, as factors
constexpr std::size_t kLeastPixels = 50, kLeastBins = 6;
constexpr double kHuber = 0.15;  // of a logarithm
constexpr int kIterations = 100;

/// Median of the variance of n Gaussian measurements, as a factor on the true one.
double median_variance_ratio(int n) {
  const double dof = n - 1;
  return std::pow(1 - 2 / (9 * dof), 3);
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

using Model = std::function<double(const Eigen::VectorXd& parameters, const NoiseBin& bin)>;

struct LogFit {
  Eigen::VectorXd parameters;
  double rms = 0;
};

/// Gauss-Newton on log(measured / model), steps at most 0.5; parameters are logs and exponents.
LogFit fit_logs(const std::vector<NoiseBin>& bins, const Model& model, Eigen::VectorXd x) {
  const auto n = x.size();
  auto log_model = [&](const Eigen::VectorXd& at, const NoiseBin& bin) { return std::log(model(at, bin)); };
  for (int k = 0; k < kIterations; ++k) {
    Eigen::MatrixXd squares = 1e-9 * Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    for (const auto& bin : bins) {
      const double here = log_model(x, bin), off = std::log(bin.sigma) - here;
      Eigen::VectorXd slope(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        constexpr double kStep = 1e-6;
        slope[i] = (log_model(x + kStep * Eigen::VectorXd::Unit(n, i), bin) - here) / kStep;
      }
      const double weight = static_cast<double>(bin.pixels) * std::min(1.0, kHuber / std::max(std::abs(off), 1e-12));
      squares += weight * slope * slope.transpose();
      right += weight * off * slope;
    }
    x += squares.ldlt().solve(right).cwiseMax(-0.5).cwiseMin(0.5);
  }
  double sum = 0, total = 0;
  for (const auto& bin : bins) {
    sum += static_cast<double>(bin.pixels) * std::pow(std::log(bin.sigma) - log_model(x, bin), 2);
    total += static_cast<double>(bin.pixels);
  }
  return {x, std::sqrt(sum / total)};
}

/// The bins to be fitted. Noise that is near its upper limit no longer follows the model.
std::vector<NoiseBin> enough_bins(const std::vector<StillPixel>& pixels, int images, bool use_amplitude, double most) {
  auto bins = noise_bins(pixels, images, use_amplitude);
  std::erase_if(bins, [=](const NoiseBin& bin) { return bin.sigma > most / 2; });
  if (bins.size() < kLeastBins)
    throw DataError(
        "the still images",
        fmt::format("fill {} bins of {} pixels or more; a fit takes {}: too few pixels, or too like each other",
                    bins.size(), kLeastPixels, kLeastBins));
  return bins;
}

/// floor and signal, and what exponents the data would have.
void fit_light(const std::vector<NoiseBin>& bins, TofNoiseFit& fit) {
  const Model free = [](const auto& x, const NoiseBin& bin) {
    return std::hypot(std::exp(x[0]), std::exp(x[1]) * std::pow(bin.range, x[2]) / std::pow(bin.amplitude, x[3]));
  };
  const double power = fit.noise.range_corrected ? 2 : 0;
  const Model fixed = [&](const auto& x, const NoiseBin& bin) {
    return free(Eigen::Vector4d(x[0], x[1], power, 1), bin);
  };
  const auto found = fit_logs(bins, fixed, Eigen::Vector2d(std::log(fit.noise.floor), std::log(fit.noise.signal)));
  fit.noise.floor = std::exp(found.parameters[0]);
  fit.noise.signal = std::exp(found.parameters[1]);
  fit.log_rms = found.rms;
  const Eigen::Vector4d start(found.parameters[0], found.parameters[1], power, 1);
  const auto exponents = fit_logs(bins, free, start).parameters;
  fit.free = {exponents[2], exponents[3]};
}

/// quadratic, and floor where nothing else has given it.
void fit_range(const std::vector<NoiseBin>& bins, bool also_floor, TofNoiseFit& fit) {
  const double log_floor = std::log(fit.noise.floor);
  const Model model = [&](const auto& x, const NoiseBin& bin) {
    return std::hypot(std::exp(also_floor ? x[1] : log_floor), std::exp(x[0]) * bin.range * bin.range);
  };
  Eigen::VectorXd start(also_floor ? 2 : 1);
  start[0] = std::log(fit.noise.quadratic);
  if (also_floor) start[1] = log_floor;
  const auto found = fit_logs(bins, model, start);
  fit.noise.quadratic = std::exp(found.parameters[0]);
  if (!also_floor) return;
  fit.noise.floor = std::exp(found.parameters[1]);
  fit.log_rms = found.rms;
}

}  // namespace

std::vector<NoiseBin> noise_bins(const std::vector<StillPixel>& pixels, int images, bool use_amplitude) {
  auto cell = [](double value, double width) {
    return static_cast<int>(std::floor(std::log(value) / std::log(width)));
  };
  std::map<std::pair<int, int>, std::vector<const StillPixel*>> cells;
  for (const auto& p : pixels) {
    if (use_amplitude && !(p.amplitude > 0)) continue;
    cells[{cell(p.range, kRangeWidth), use_amplitude ? cell(p.amplitude, kAmplitudeWidth) : 0}].push_back(&p);
  }
  std::vector<NoiseBin> bins;
  for (const auto& [key, members] : cells) {
    if (members.size() < kLeastPixels) continue;
    const auto n = static_cast<double>(members.size());
    std::vector<double> variances;
    double log_range = 0, log_amplitude = 0;
    for (const auto* p : members) {
      variances.push_back(p->variance);
      log_range += std::log(p->range) / n;
      if (use_amplitude) log_amplitude += std::log(p->amplitude) / n;
    }
    const double sigma = std::sqrt(median(variances) / median_variance_ratio(images));
    if (sigma > 0)
      bins.push_back({std::exp(log_range), use_amplitude ? std::exp(log_amplitude) : 0, sigma, members.size()});
  }
  return bins;
}

TofNoiseFit fit_tof_noise(const std::vector<StillPixel>& pixels, int images, bool with_amplitude,
                          const TofNoise& start) {
  TofNoiseFit fit;
  fit.noise = start;
  if (with_amplitude) fit_light(enough_bins(pixels, images, true, start.most), fit);
  fit_range(enough_bins(pixels, images, false, start.most), !with_amplitude, fit);
  return fit;
}

NoiseShares noise_shares(const std::vector<StillPixel>& pixels, int images, bool with_amplitude,
                         const TofNoise& noise) {
  const double shrink = std::sqrt((images - 1.0) / images);
  NoiseShares shares;
  for (const auto& p : pixels) {
    const double sigma = shrink * (with_amplitude ? noise.sigma(p.range, p.amplitude) : noise.sigma(p.range));
    for (const float off : p.deviation) {
      const double t = std::abs(off) / sigma;
      shares.within_1 += t <= 1;
      shares.within_2 += t <= 2;
      shares.within_3 += t <= 3;
      ++shares.deviations;
    }
  }
  if (shares.deviations == 0) return shares;
  const auto n = static_cast<double>(shares.deviations);
  return {shares.within_1 / n, shares.within_2 / n, shares.within_3 / n, shares.deviations};
}

}  // namespace ppm
