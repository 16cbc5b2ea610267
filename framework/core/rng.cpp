#include "framework/core/rng.hpp"

#include <Random123/philox.h>
#include <cmath>
#include <numbers>

#include "framework/core/error.hpp"

namespace ppm {

// The counter is (block, frame, particle, purpose): no two streams overlap, and each has 2^34 words before it repeats.
Rng::Rng(std::uint64_t seed, std::uint32_t frame, std::uint32_t particle, std::uint32_t purpose)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      counter_{0, frame, particle, purpose} {}

std::uint32_t Rng::bits() {
  if (used_ == 4) {
    const r123::Philox4x32::ctr_type counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
    const r123::Philox4x32::key_type key{{key_[0], key_[1]}};
    const auto block = r123::Philox4x32{}(counter, key);
    for (std::size_t i = 0; i < 4; ++i) block_[i] = block[i];
    ++counter_[0];
    used_ = 0;
  }
  return block_[static_cast<std::size_t>(used_++)];
}

double Rng::uniform() {
  const std::uint64_t high = bits() >> 5, low = bits() >> 6;  // 27 and 26 bits
  return static_cast<double>((high << 26) | low) * 0x1.0p-53;
}

double Rng::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  const double angle = 2.0 * std::numbers::pi * uniform();
  spare_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

std::uint32_t Rng::below(std::uint32_t n) {
  PPM_CHECK(n >= 1, "no integer below 0");
  // Lemire, "Fast random integer generation in an interval", 2019: exactly uniform.
  const std::uint32_t reject_below = (0u - n) % n;
  std::uint64_t product;
  do {
    product = std::uint64_t{bits()} * n;
  } while (static_cast<std::uint32_t>(product) < reject_below);
  return static_cast<std::uint32_t>(product >> 32);
}

std::uint32_t purpose_key(std::string_view purpose) {
  std::uint32_t hash = 2166136261u;  // FNV-1a
  for (unsigned char c : purpose) hash = (hash ^ c) * 16777619u;
  return hash;
}

}  // namespace ppm
