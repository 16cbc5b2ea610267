#pragma once
#include <cstddef>
#include <map>
#include <optional>

namespace ppm {

/// Hands out ranges of a growing line of elements, the lowest that fits first. Neighbouring free ranges are one.
class RangeAllocator {
 public:
  /// The first element of `count` free ones, or nothing where none are left side by side. count > 0.
  std::optional<std::size_t> take(std::size_t count);
  /// Frees what take() gave.
  void give_back(std::size_t first, std::size_t count);
  /// Adds free elements behind the last one. capacity: all elements then.
  void grow(std::size_t capacity);

  std::size_t capacity() const { return capacity_; }
  std::size_t used() const { return used_; }

 private:
  std::map<std::size_t, std::size_t> free_;  // first element: count
  std::size_t capacity_ = 0, used_ = 0;
};

}  // namespace ppm
