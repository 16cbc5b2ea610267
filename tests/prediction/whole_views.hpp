#pragma once
#include <catch2/catch.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "framework/core/digest.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm::test {

/// The particles' views with their arrays filled. Checks on the way that the samples of each view say what its arrays
/// say.
inline std::vector<PredictionHandle> whole_views(const ParticleSet& belief) {
  PredictionPool pool;
  const Workers workers(1);
  std::vector<PredictionHandle> whole;
  for (const auto& view : belief.prediction) {
    whole.push_back(completed(view, pool, workers));
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(view->camera.pixels()));
    std::iota(pixels.begin(), pixels.end(), 0u);
    ViewSamples given, from_arrays;
    for (auto* samples : {&given, &from_arrays}) samples->resize(pixels.size(), view->color_channels);
    view->sample(pixels, given);
    whole.back()->sample(pixels, from_arrays);
    CHECK(given.color == from_arrays.color);
    CHECK(given.color_variance == from_arrays.color_variance);
    std::size_t wrong = 0;
    for (auto p : pixels) {
      if (!whole.back()->hit(p)) {
        wrong += given.range[p] != Prediction::kMiss || given.variance[p] != 0 || given.cosine[p] != 1;
        continue;
      }
      const auto near = [](float a, float b, double margin) { return a == Approx(b).epsilon(1e-4).margin(margin); };
      wrong += !near(given.range[p], from_arrays.range[p], 1e-5) || !near(given.cosine[p], from_arrays.cosine[p], 1e-5) ||
               !near(given.variance[p], from_arrays.variance[p], 1e-10);
    }
    CHECK(wrong == 0);
    std::vector<std::uint32_t> chunk(pixels.size()), face(pixels.size());
    view->elements(all_rows(view->camera), chunk, face);
    CHECK(chunk == whole.back()->chunk);
    CHECK(face == whole.back()->face);
  }
  return whole;
}

/// What a view's arrays say of its geometry, as one number.
inline std::string bytes_of(const Prediction& view) {
  Digest digest;
  for (const auto* array : {&view.range, &view.mean, &view.variance, &view.normal, &view.bary}) digest.add(*array);
  digest.add(view.chunk);
  digest.add(view.face);
  return digest.hex();
}

}  // namespace ppm::test
