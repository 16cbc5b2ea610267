#include "modules/prediction/gl_heap.hpp"

#include <algorithm>

#include "modules/prediction/gl_functions.hpp"

namespace ppm {
namespace {

constexpr std::size_t kFirst = 1 << 14;  // elements of a heap at first

GLintptr offset(std::size_t bytes) {
  return static_cast<GLintptr>(bytes);
}

}  // namespace

GlHeap::~GlHeap() {
  gl_.DeleteBuffers(1, &buffer_);
}

std::size_t GlHeap::add(const void* data, std::size_t count) {
  auto first = ranges_.take(count);
  if (!first) {
    grow(count);
    first = ranges_.take(count);
  }
  gl_.NamedBufferSubData(buffer_, offset(*first * element_), offset(count * element_), data);
  return *first;
}

void GlHeap::grow(std::size_t needed) {
  const std::size_t old = ranges_.capacity(), capacity = std::max({kFirst, 2 * old, old + needed});
  unsigned larger = 0;
  gl_.CreateBuffers(1, &larger);
  gl_.NamedBufferStorage(larger, offset(capacity * element_), nullptr, GL_DYNAMIC_STORAGE_BIT);
  if (buffer_) gl_.CopyNamedBufferSubData(buffer_, larger, 0, 0, offset(old * element_));
  gl_.DeleteBuffers(1, &buffer_);
  buffer_ = larger;
  ranges_.grow(capacity);
}

}  // namespace ppm
