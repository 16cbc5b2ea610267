// A view is the same in whatever form it is asked for: alone or among others, by one thread or several, sampled at some
// pixels or filled.
#include <catch2/catch.hpp>

#include "framework/core/rng.hpp"
#include "modules/maps/ppm/meshed_room.hpp"
#include "tests/prediction/backends.hpp"
#include "tests/prediction/whole_views.hpp"

using namespace ppm;
using namespace ppm::test;

namespace {

const Camera kCamera{75, 58, 60, 60, 37, 28.5};

std::shared_ptr<const PpmMap> room() {
  static const auto map = map_of(
      meshed_room(4000), {}, [](const Eigen::Vector3f& p) { return 0.01f * std::sin(5 * p.x()); }, 1e-4f);
  return map;
}

std::vector<Look> looks(std::size_t n) {
  std::vector<Look> found;
  for (std::size_t i = 0; i < n; ++i) found.push_back({kCamera, 1, room_view(0.4 * static_cast<double>(i))});
  return found;
}

std::vector<std::string> bytes_of(const Views& views) {
  std::vector<std::string> bytes;
  for (const auto& view : views.of) bytes.push_back(test::bytes_of(*filled(view)));
  return bytes;
}

/// Every third pixel or so, ascending.
std::vector<std::uint32_t> some_pixels(std::uint64_t seed) {
  Rng rng(seed, 0, 0, purpose_key("pixels"));
  std::vector<std::uint32_t> pixels;
  for (int p = 0; p < kCamera.pixels(); ++p)
    if (rng.uniform() < 0.3) pixels.push_back(static_cast<std::uint32_t>(p));
  return pixels;
}

void compare_samples(const Prediction& view, const std::vector<std::uint32_t>& pixels) {
  const auto exact = filled(std::make_shared<const Prediction>(view));
  ViewSamples asked, wanted;
  asked.resize(pixels.size());
  wanted.resize(pixels.size());
  view.sample(pixels, asked);
  exact->sample(pixels, wanted);
  std::size_t different = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const bool same = asked.range[i] == wanted.range[i] ||
                      (std::abs(asked.range[i] - wanted.range[i]) <= 2e-6f * wanted.range[i] &&
                       std::abs(asked.variance[i] - wanted.variance[i]) <= 2e-5f * wanted.variance[i] &&
                       std::abs(asked.cosine[i] - wanted.cosine[i]) <= 2e-6f);
    different += !same;
  }
  CHECK(different == 0);
}

}  // namespace

TEST_CASE("a view is the same bytes alone and among others, by any number of threads") {
  for (const auto& backend : exact_backends()) {
    INFO(backend);
    const auto views = looks(9);
    const auto together = bytes_of(deferred_views(backend, room(), views));
    CHECK(bytes_of(deferred_views(backend, room(), views, 3)) == together);
    for (std::size_t i : {0u, 4u}) {
      CHECK(bytes_of(deferred_views(backend, room(), {views[i]})).front() == together[i]);
      CHECK(bytes_of(deferred_views(backend, room(), {views[i]}, 2)).front() == together[i]);
    }
  }
}

TEST_CASE("samples of a view are what its arrays say") {
  for (const auto& backend : exact_backends()) {
    INFO(backend);
    const auto views = deferred_views(backend, room(), looks(1));
    const auto& view = views.of.front();
    for (std::uint64_t seed : {1, 2, 3}) compare_samples(*view, some_pixels(seed));
    compare_samples(*view, {});
    compare_samples(*view, {0});
    compare_samples(*view, {static_cast<std::uint32_t>(kCamera.pixels() - 1)});
  }
}

TEST_CASE("a view that defers its arrays fills any rows alike") {
  for (const auto& backend : exact_backends()) {
    const auto views = deferred_views(backend, room(), looks(1));
    const auto& view = views.of.front();
    if (!view->deferred) continue;
    INFO(backend);
    Prediction out;
    out.reset(view->camera, 1, view->T_map_camera);
    for (int first = 0; first < kCamera.rows; first += 7)
      view->deferred->fill(*view, {first, std::min(first + 7, kCamera.rows)}, out);
    CHECK(bytes_of(out) == bytes_of(*filled(view)));
  }
}
