#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>

#include "framework/core/rng.hpp"
#include "tests/support/ppm_maps.hpp"

namespace ppm::test {

/// A wavy sheet in several chunks with random texels, excess variance, and colour where channels > 0.
inline std::shared_ptr<const PpmMap> textured_sheet(int channels = 0) {
  PpmSettings settings;
  settings.cell_size_m = 0.4;
  settings.color_channels = channels;
  PpmEdit edit(std::make_shared<PpmMap>(settings));
  constexpr std::uint32_t kSide = 6;
  Rng rng(11, 0, 0, 0);
  std::vector<std::uint32_t> id;
  for (std::uint32_t y = 0; y <= kSide; ++y)
    for (std::uint32_t x = 0; x <= kSide; ++x)
      id.push_back(edit.add_vertex(
          {0.1f * static_cast<float>(x), 0.1f * static_cast<float>(y), 0.03f * std::sin(static_cast<float>(x + 2 * y))}));
  auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto n = static_cast<std::uint8_t>(1 + rng.below(6));
    std::vector<float> mean(texel_count(n)), variance(texel_count(n)),
        color(texel_count(n) * static_cast<std::size_t>(channels)), color_variance(channels > 0 ? texel_count(n) : 0, 1e-3f);
    for (auto& m : mean) m = static_cast<float>(0.003 * rng.normal());
    for (auto& v : variance) v = static_cast<float>(1e-5 * (0.1 + rng.uniform()));
    for (auto& v : color) v = static_cast<float>(rng.uniform());
    FaceEvidence evidence;
    evidence.excess = static_cast<float>(1e-5 * (rng.uniform() - 0.3));
    edit.add_face({id[a], id[b], id[c]}, n, {mean, variance, color, color_variance}, evidence);
  };
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = y * (kSide + 1) + x, b = a + 1, c = a + kSide + 1, d = c + 1;
      face(a, b, d);
      face(a, d, c);
    }
  return edit.commit();
}

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace ppm::test
