#include <catch2/catch.hpp>
#include <cstring>

#include "modules/weighting/range_kernels.hpp"
#include "tests/support/range_reference.hpp"
#include "tests/support/simd_targets.hpp"

using namespace ppm;

namespace {

const MixtureTerms kTerms{0.01, 0.1, 0.9, 25e-6};

void check_equal(const ViewScore& fast, const ViewScore& exact) {
  CHECK(fast.log_likelihood == Approx(exact.log_likelihood).epsilon(1e-5).margin(1e-5));
  CHECK(fast.residual_sum == Approx(exact.residual_sum).epsilon(1e-5));
  CHECK(fast.hits == exact.hits);
  CHECK(fast.misses == exact.misses);
  CHECK(fast.outliers == exact.outliers);
}

}  // namespace

TEST_CASE("likelihood kernels agree with sums in double") {
  const std::size_t n = GENERATE(0, 1, 15, 16, 17, 100, 1024);
  const test::RangePixels pixels(n + 3, 7 + n);
  const RangeArrays a = pixels.arrays(3, n);  // not aligned
  check_equal(gaussian_score(a, true), test::gaussian_reference(a, true));
  check_equal(gaussian_score(a, false), test::gaussian_reference(a, false));
  check_equal(mixture_score(a, kTerms), test::mixture_reference(a, kTerms));
}

TEST_CASE("likelihood kernels agree with sums in double where densities are extreme") {
  test::RangePixels pixels(1024);
  for (std::size_t i = 0; i < 1024; ++i) {
    pixels.expected_variance[i] = i % 2 ? 1e4f : 1e-9f;
    if (i % 3 == 0) pixels.expected_range[i] = i % 2 ? -5e3f : 1e4f;
    if (i % 5 == 0) pixels.expected_range[i] = pixels.range[i];
  }
  const RangeArrays a = pixels.arrays(0, 1024);
  check_equal(gaussian_score(a, true), test::gaussian_reference(a, true));
  check_equal(gaussian_score(a, false), test::gaussian_reference(a, false));
  for (double outlier : {1e-15, 1e-3, 1e3}) {
    const MixtureTerms terms{outlier, 1e-6, 0.5, 0};
    check_equal(mixture_score(a, terms), test::mixture_reference(a, terms));
  }
}

TEST_CASE("a certain map without sensor noise has the least variance") {
  test::RangePixels pixels(16);
  for (auto* array : {&pixels.variance, &pixels.expected_variance, &pixels.lateral})
    std::fill(array->begin(), array->end(), 0.0f);
  const RangeArrays a = pixels.arrays(0, 16);
  CHECK(gaussian_score(a, true).log_likelihood == Approx(test::gaussian_reference(a, true).log_likelihood));
  CHECK(std::isfinite(mixture_score(a, {0.01, 0.1, 0.9, 0}).log_likelihood));
}

TEST_CASE("likelihood kernels give no number for what is none, on every target") {
  test::on_every_target([] {
    for (auto array : {&test::RangePixels::expected_range, &test::RangePixels::expected_variance,
                       &test::RangePixels::cosine, &test::RangePixels::variance})
      for (std::size_t at : {3, 20, 97}) {
        test::RangePixels pixels(100);
        pixels.expected_range[at] = pixels.range[at];
        (pixels.*array)[at] = NAN;
        const RangeArrays a = pixels.arrays(0, 100);
        CHECK(std::isnan(mixture_score(a, kTerms).log_likelihood));
        if (array != &test::RangePixels::cosine) CHECK(std::isnan(gaussian_score(a, true).log_likelihood));
      }
    test::RangePixels pixels(100);
    pixels.expected_range[50] = 2;
    pixels.expected_variance[50] = INFINITY;
    CHECK_FALSE(std::isfinite(gaussian_score(pixels.arrays(0, 100), true).log_likelihood));
    CHECK(std::isfinite(mixture_score(pixels.arrays(0, 100), kTerms).log_likelihood));  // certainly an outlier
  });
}

TEST_CASE("likelihood kernels give the same bytes on every target") {
  const test::RangePixels pixels(1017);
  const RangeArrays a = pixels.arrays(0, 1017);
  const ViewScore gaussian = gaussian_score(a, true), mixture = mixture_score(a, kTerms);
  std::size_t targets = 0;
  test::on_every_target([&] {
    ++targets;
    const ViewScore g = gaussian_score(a, true), m = mixture_score(a, kTerms);
    CHECK(std::memcmp(&g, &gaussian, sizeof g) == 0);
    CHECK(std::memcmp(&m, &mixture, sizeof m) == 0);
  });
  CHECK(targets >= 1);
}
