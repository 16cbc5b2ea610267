#include "modules/prediction/range_allocator.hpp"

#include "framework/core/error.hpp"

namespace ppm {

std::optional<std::size_t> RangeAllocator::take(std::size_t count) {
  for (auto it = free_.begin(); it != free_.end(); ++it) {
    const auto [first, size] = *it;
    if (size < count) continue;
    free_.erase(it);
    if (size > count) free_.emplace(first + count, size - count);
    used_ += count;
    return first;
  }
  return std::nullopt;
}

void RangeAllocator::give_back(std::size_t first, std::size_t count) {
  PPM_CHECK(count <= used_ && first + count <= capacity_, "elements {} to {} of {}", first, first + count, capacity_);
  used_ -= count;
  auto next = free_.lower_bound(first);
  if (next != free_.end() && next->first == first + count) {
    count += next->second;
    next = free_.erase(next);
  }
  if (next != free_.begin()) {
    const auto before = std::prev(next);
    if (before->first + before->second == first) {
      before->second += count;
      return;
    }
  }
  free_.emplace_hint(next, first, count);
}

void RangeAllocator::grow(std::size_t capacity) {
  const std::size_t added = capacity - capacity_, first = capacity_;
  capacity_ = capacity;
  used_ += added;
  give_back(first, added);
}

}  // namespace ppm
