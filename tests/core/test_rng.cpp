#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "framework/core/error.hpp"
#include "framework/core/rng.hpp"

using ppm::Rng;

namespace {

using Block = std::array<std::uint32_t, 4>;

/// Philox4x32-10 written out from the paper (Salmon et al. 2011, section 3.3), as an oracle.
Block philox(Block c, std::array<std::uint32_t, 2> k) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = 0xD2511F53ull * c[0], b = 0xCD9E8D57ull * c[2];
    c = {static_cast<std::uint32_t>(b >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(b),
         static_cast<std::uint32_t>(a >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(a)};
    k[0] += 0x9E3779B9u;
    k[1] += 0xBB67AE85u;
  }
  return c;
}

}  // namespace

TEST_CASE("the oracle gives Random123's known answers") {
  // tests/kat_vectors of Random123: philox4x32 10
  CHECK(philox({0, 0, 0, 0}, {0, 0}) == Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  const std::uint32_t f = 0xffffffff;
  CHECK(philox({f, f, f, f}, {f, f}) == Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("a stream is Philox over (block, frame, particle, purpose), keyed by the seed") {
  const std::uint64_t seed = 0x299f31d0a4093822ull;
  Rng rng(seed, 0x85a308d3, 0x13198a2e, 0x03707344);
  for (std::uint32_t block = 0; block < 50; ++block) {
    const auto expected = philox({block, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0});
    for (auto word : expected) CHECK(rng.bits() == word);
  }
}

TEST_CASE("a stream does not depend on the order in which streams are drawn from") {
  auto draw = [](Rng& r) { return std::array{r.uniform(), r.normal(), static_cast<double>(r.below(1000))}; };
  std::vector<std::array<double, 3>> forward;
  for (std::uint32_t p = 0; p < 100; ++p) {
    Rng r(3, 7, p, ppm::purpose_key("motion/noise"));
    forward.push_back(draw(r));
  }
  std::vector<Rng> all;
  for (std::uint32_t p = 0; p < 100; ++p) all.emplace_back(3, 7, p, ppm::purpose_key("motion/noise"));
  for (std::size_t p = 100; p-- > 0;) CHECK(draw(all[p]) == forward[p]);
}

TEST_CASE("each part of the key makes another stream") {
  std::set<std::uint32_t> first;
  first.insert(Rng(1, 2, 3, 4).bits());
  first.insert(Rng(2, 2, 3, 4).bits());
  first.insert(Rng(1ull << 32 | 1, 2, 3, 4).bits());
  first.insert(Rng(1, 3, 3, 4).bits());
  first.insert(Rng(1, 2, 4, 4).bits());
  first.insert(Rng(1, 2, 3, 5).bits());
  CHECK(first.size() == 6);
}

TEST_CASE("uniform numbers: range, mean, variance, no word used twice") {
  Rng rng(5, 0, 0, 0);
  const int n = 200'000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double u = rng.uniform();
    REQUIRE(u >= 0);
    REQUIRE(u < 1);
    sum += u;
    squares += u * u;
  }
  CHECK(sum / n == Approx(0.5).margin(0.003));  // 4.6 sigma
  CHECK(squares / n - sum / n * sum / n == Approx(1.0 / 12).margin(0.001));

  Rng words(5, 0, 0, 0), uniforms(5, 0, 0, 0);
  uniforms.uniform();
  words.bits();
  words.bits();
  CHECK(words.bits() == uniforms.bits());
}

TEST_CASE("normal numbers: moments and tails") {
  Rng rng(6, 0, 0, 0);
  const int n = 200'000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  int beyond_2 = 0;
  for (int i = 0; i < n; ++i) {
    const double z = rng.normal();
    REQUIRE(std::isfinite(z));
    m1 += z / n;
    m2 += z * z / n;
    m3 += z * z * z / n;
    m4 += z * z * z * z / n;
    if (std::abs(z) > 2) ++beyond_2;
  }
  CHECK(m1 == Approx(0).margin(0.01));
  CHECK(m2 == Approx(1).margin(0.015));
  CHECK(m3 == Approx(0).margin(0.03));
  CHECK(m4 == Approx(3).margin(0.12));
  CHECK(beyond_2 / double(n) == Approx(0.0455).margin(0.002));
}

TEST_CASE("two normals in a row are independent") {
  Rng rng(8, 0, 0, 0);
  const int n = 100'000;
  double product = 0;
  for (int i = 0; i < n; ++i) {
    const double a = rng.normal();
    product += a * rng.normal() / n;
  }
  CHECK(product == Approx(0).margin(0.015));
}

TEST_CASE("integers below n: every value, equally often") {
  Rng rng(9, 0, 0, 0);
  std::array<int, 7> count{};
  for (int i = 0; i < 70'000; ++i) ++count[rng.below(7)];
  for (int c : count) CHECK(c == Approx(10'000).margin(430));
  for (int i = 0; i < 100; ++i) CHECK(rng.below(1) == 0);
  // 3 * 2^30: a plain modulo would give the lowest third twice as often
  int low = 0;
  for (int i = 0; i < 30'000; ++i) low += rng.below(3u << 30) < (1u << 30) ? 1 : 0;
  CHECK(low == Approx(10'000).margin(400));
  CHECK_THROWS_AS(rng.below(0), ppm::InternalError);
}

TEST_CASE("purpose keys are stable and differ") {
  CHECK(ppm::purpose_key("") == 2166136261u);
  CHECK(ppm::purpose_key("a") == 0xe40c292cu);  // published FNV-1a answers
  CHECK(ppm::purpose_key("foobar") == 0xbf9cf968u);
  CHECK(ppm::purpose_key("motion/noise") != ppm::purpose_key("motion/nois"));
}
