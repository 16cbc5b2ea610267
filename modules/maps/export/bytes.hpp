#pragma once
#include <bit>
#include <string>
#include <type_traits>
#include <vector>

static_assert(std::endian::native == std::endian::little, "files are little endian and are written from memory");

namespace ppm {

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  static_assert(std::is_arithmetic_v<T>);
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

}  // namespace ppm
