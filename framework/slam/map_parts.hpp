#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "framework/core/record.hpp"

namespace ppm {

// What maps share, in a file: each part once, and maps name parts by number. See MapCodec.

/// Distinct parts in the order in which they are met. Owns none.
template <class T>
class MapParts {
 public:
  std::uint32_t number(const T* part) {
    const auto [it, added] = number_.emplace(part, static_cast<std::uint32_t>(all_.size()));
    if (added) all_.push_back(part);
    return it->second;
  }
  const std::vector<const T*>& all() const { return all_; }

 private:
  std::unordered_map<const T*, std::uint32_t> number_;
  std::vector<const T*> all_;
};

/// The part that a record names. Throws DataError where there is none of that number.
template <class T>
const T& part_of(const std::vector<T>& parts, std::uint32_t number, const RecordReader& in) {
  if (number >= parts.size()) in.fail("names a part that is not there");
  return parts[number];
}

}  // namespace ppm
