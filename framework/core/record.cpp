#include "framework/core/record.hpp"

#include <bit>

#include "framework/core/error.hpp"

static_assert(std::endian::native == std::endian::little, "records are little endian, and are memory as it is");

namespace ppm {

void RecordReader::finish() const {
  if (!bytes_.empty()) fail("has bytes left over");
}

void RecordReader::fail(const std::string& reason) const {
  throw DataError(file_, what_ + " " + reason);
}

const char* RecordReader::need(std::size_t count) {
  if (count > bytes_.size()) fail("is shorter than its counts say");
  const char* data = bytes_.data();
  bytes_.remove_prefix(count);
  return data;
}

std::size_t RecordReader::take_count(std::size_t element_bytes) {
  const auto count = take<std::uint64_t>();
  if (count > bytes_.size() / element_bytes) fail("is shorter than its counts say");
  return count;
}

}  // namespace ppm
