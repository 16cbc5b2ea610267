#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// The faces of a map counted through, chunk after chunk, so that one number names a face.
class FaceNumbers {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;  ///< no face

  explicit FaceNumbers(const PpmMap& map) {
    first_.reserve(map.table().size() + 1);
    std::uint64_t count = 0;
    for (const PpmChunk& chunk : map.table().chunks()) {
      first_.push_back(static_cast<std::uint32_t>(count));
      count += chunk.geometry->face.size();
    }
    PPM_CHECK(count < kNone, "{} faces in a map", count);
    first_.push_back(static_cast<std::uint32_t>(count));
  }

  /// The number of a chunk's first face.
  std::uint32_t first(std::uint32_t chunk) const { return first_[chunk]; }
  /// The chunk of a face's number. guess: tried first, any chunk.
  std::uint32_t chunk_of(std::uint32_t number, std::uint32_t guess) const {
    if (first_[guess] <= number && number < first_[guess + 1]) return guess;
    return static_cast<std::uint32_t>(std::ranges::upper_bound(first_, number) - first_.begin()) - 1;
  }

 private:
  std::vector<std::uint32_t> first_;  // by chunk, and the count of all faces
};

}  // namespace ppm
