#include "apps/calibrate_sensor.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <iterator>
#include <memory>

#include "apps/graph_options.hpp"
#include "framework/core/atomic_file.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/slam/tof_noise_fit.hpp"

namespace ppm {
namespace {

struct SensorOptions {
  GraphOptions graph;
  int still = 4;
  bool raw_amplitude = false;
  std::filesystem::path bins;
};

/// The pixels of all places.
struct StillPlaces {
  std::vector<StillPixel> pixels;
  int places = 0, images = 0;  ///< images: of each place
  bool amplitudes = false;
};

StillPlaces look(const FrameSource& source, const GraphOptions& graph, int still) {
  const auto& selected = source.selected();
  if (selected.size() % static_cast<std::size_t>(still) != 0)
    throw ConfigError(Place{graph.file.string()},
                      fmt::format("the source gives {} images, which are not places of {} images each (--still)",
                                  selected.size(), still));
  StillPlaces out;
  out.images = still;
  for (std::size_t first = 0; first < selected.size(); first += static_cast<std::size_t>(still), ++out.places) {
    std::vector<Frame> frames;
    for (int k = 0; k < still; ++k) frames.push_back(source.full_frame(selected[first + static_cast<std::size_t>(k)]));
    const bool amplitudes = !frames.front().confidence.empty();
    if (out.places > 0 && amplitudes != out.amplitudes)
      throw DataError("the still images", frames.front().index, "only some places have a confidence");
    out.amplitudes = amplitudes;
    std::ranges::move(still_pixels(frames, out.places), std::back_inserter(out.pixels));
  }
  return out;
}

void print_parameters(const TofNoiseFit& fit, bool amplitudes) {
  const TofNoise& n = fit.noise;
  fmt::print("sensor.tof:\n  sigma_floor: {:.4g} m\n", n.floor);
  if (amplitudes) fmt::print("  signal_noise: {:.4g}\n  range_corrected: {}\n", n.signal, n.range_corrected);
  fmt::print("  sigma_quadratic: {:.4g}\n", n.quadratic);
}

void print_shares(const std::string& name, const NoiseShares& s) {
  fmt::print("#   {:<26} {:.3f} {:.3f} {:.3f}  ({} deviations)\n", name, s.within_1, s.within_2, s.within_3,
             s.deviations);
}

/// How well each place is described by a fit to all others.
void print_left_out(const StillPlaces& still, const TofNoise& start) {
  for (int place = 0; place < still.places; ++place) {
    std::vector<StillPixel> others, own;
    for (const auto& p : still.pixels) (p.group == place ? own : others).push_back(p);
    const auto fit = fit_tof_noise(others, still.images, still.amplitudes, start);
    print_shares(fmt::format("place {}, fit to the others", place + 1),
                 noise_shares(own, still.images, still.amplitudes, fit.noise));
  }
}

std::string bins_csv(const StillPlaces& still, const TofNoise& noise) {
  std::string text = "range_m,amplitude,sigma_m,model_m,pixels\n";
  for (const auto& b : noise_bins(still.pixels, still.images, still.amplitudes))
    text += fmt::format("{:.4f},{:.1f},{:.5f},{:.5f},{}\n", b.range, b.amplitude, b.sigma,
                        still.amplitudes ? noise.sigma(b.range, b.amplitude) : noise.sigma(b.range), b.pixels);
  return text;
}

void calibrate_sensor(const SensorOptions& o) {
  const Graph graph = o.graph.load();
  auto* source = graph.first<FrameSource>();
  if (!source) throw ConfigError(Place{o.graph.file.string()}, "the graph has no source of images");
  source->open_for_evaluation();
  const StillPlaces still = look(*source, o.graph, o.still);
  TofNoise start;
  start.range_corrected = !o.raw_amplitude;
  const auto fit = fit_tof_noise(still.pixels, still.images, still.amplitudes, start);
  print_parameters(fit, still.amplitudes);
  fmt::print("# {} places of {} images, {} pixels with a return in all of them\n", still.places, still.images,
             still.pixels.size());
  fmt::print("# log(measured / model) over bins of range{}: rms {:.3f}\n", still.amplitudes ? " and amplitude" : "",
             fit.log_rms);
  if (fit.free)
    fmt::print("# exponents, were they free: range {:.2f}, amplitude {:.2f}\n", fit.free->range, -fit.free->amplitude);
  fmt::print("# within 1, 2, 3 sigma (Gaussian noise: 0.683 0.954 0.997)\n");
  print_shares("all, this fit", noise_shares(still.pixels, still.images, still.amplitudes, fit.noise));
  if (still.places > 1) print_left_out(still, start);
  if (!o.bins.empty()) write_file(o.bins, bins_csv(still, fit.noise));
}

}  // namespace

void add_calibrate_sensor(CLI::App& calibrate) {
  auto* command = calibrate.add_subcommand(
      "sensor", "Noise of a time-of-flight camera: sensor.tof, from images of places at which the camera stood still");
  auto o = std::make_shared<SensorOptions>();
  o->graph.add_to(*command);
  command->add_option("--still", o->still, "Images a place; the source's images are taken so many at a time")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  command->add_flag("--raw-amplitude", o->raw_amplitude,
                    "The camera reports the light as it comes back, not made up for the distance");
  command->add_option("--bins", o->bins, "Also write the bins of the fit as CSV")->type_name("FILE");
  command->callback([o] { calibrate_sensor(*o); });
}

}  // namespace ppm
