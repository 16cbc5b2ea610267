#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace ppm {

/// Counter-based random numbers: the stream is a pure function of its key, so the same bytes come out whatever the
/// number of threads and the order of the calls. Cheap to make: create one where it is needed, never keep it.
/// Source: Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011 (Philox4x32-10, librandom123).
class Rng {
 public:
  /// key: seed of the run; frame and particle: what the numbers are for; purpose: hash of who draws (see purpose_key).
  Rng(std::uint64_t seed, std::uint32_t frame, std::uint32_t particle, std::uint32_t purpose);

  std::uint32_t bits();
  /// Uniform in [0, 1), 53 random bits.
  double uniform();
  /// Standard normal (Box-Muller; no draw is thrown away, so the stream position is known).
  double normal();
  /// Uniform integer in [0, n), n >= 1.
  std::uint32_t below(std::uint32_t n);

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;
  double spare_ = 0;
  bool has_spare_ = false;
};

/// Stable 32-bit hash of a purpose such as "motion/noise".
std::uint32_t purpose_key(std::string_view purpose);

}  // namespace ppm
