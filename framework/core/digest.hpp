#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace ppm {

/// 128-bit hash of a sequence of bytes (XXH3), for "same seed, same bytes" and for checksums of files. Not cryptographic.
class Digest {
 public:
  Digest();
  ~Digest();
  void add(const void* data, std::size_t bytes);
  template <class T>
  void add(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>, "padding bytes would be hashed: add members one by one");
    add(&value, sizeof value);
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(values.size());
    add(values.data(), values.size() * sizeof(T));
  }
  void add(const std::string& text) {
    add(text.size());
    add(text.data(), text.size());
  }
  /// 32 hexadecimal digits of all that was added so far.
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ppm
