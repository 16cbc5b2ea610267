#pragma once
#include <cstddef>
#include <cstdint>

#include "modules/prediction/range_allocator.hpp"

namespace ppm {

struct GlFunctions;

/// Elements of one size in a buffer on the device that grows: ranges of it are taken, written once, and given back.
/// Every call, the destructor too, needs the context to be current.
class GlHeap {
 public:
  /// element: bytes of one.
  GlHeap(const GlFunctions& gl, std::size_t element) : gl_(gl), element_(element) {}
  GlHeap(const GlHeap&) = delete;
  GlHeap& operator=(const GlHeap&) = delete;
  ~GlHeap();

  /// Copies `count` elements to the device; returns where they lie, in elements. data: count * element bytes.
  std::size_t add(const void* data, std::size_t count);
  void remove(std::size_t first, std::size_t count) { ranges_.give_back(first, count); }
  /// The buffer: another one after an add() that made it grow. 0 as long as nothing was added.
  unsigned buffer() const { return buffer_; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(ranges_.capacity() * element_); }

 private:
  void grow(std::size_t needed);

  const GlFunctions& gl_;
  std::size_t element_;
  unsigned buffer_ = 0;
  RangeAllocator ranges_;
};

}  // namespace ppm
