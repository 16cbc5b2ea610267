#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <cstring>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace ppm {

class RecordWriter;
class RecordReader;

/// Whether a type's bytes are its value: what can be copied as bytes and refers to nothing, and Eigen's types of fixed size.
template <class T>
struct IsPlain : std::bool_constant<std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::ranges::view<T>> {};
template <class S, int R, int C, int O, int MR, int MC>
struct IsPlain<Eigen::Matrix<S, R, C, O, MR, MC>> : std::bool_constant<R != Eigen::Dynamic && C != Eigen::Dynamic> {};
template <class S, int D, int M, int O>
struct IsPlain<Eigen::Transform<S, D, M, O>> : std::true_type {};
template <class S, int O>
struct IsPlain<Eigen::Quaternion<S, O>> : std::true_type {};

/// A type with functions of its own in its namespace: save(RecordWriter&, const T&) and load(RecordReader&, T&).
template <class T>
concept SavedByFunctions = requires(RecordWriter& out, RecordReader& in, const T& written, T& read) {
  save(out, written);
  load(in, read);
};

/// What is written as it stands in memory.
template <class T>
constexpr bool kAsBytes = IsPlain<T>::value && !SavedByFunctions<T>;

/// Values in a row, as bytes, little endian. It takes types with functions of their own, plain types (see
/// IsPlain), texts, and vectors and optionals of what it takes; any other is an error of the compiler.
class RecordWriter {
 public:
  template <class T>
  void add(const T& value) {
    if constexpr (kAsBytes<T>) {
      append(&value, sizeof value);
    } else if constexpr (SavedByFunctions<T>) {
      save(*this, value);
    } else {
      static_assert(!sizeof(T), "no way to save T: give it save(RecordWriter&, const T&) and load(RecordReader&, T&)");
    }
  }
  void add(const std::string& text) {
    add(static_cast<std::uint64_t>(text.size()));
    append(text.data(), text.size());
  }
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(!std::is_same_v<T, bool>, "std::vector<bool> has no elements to refer to");
    add(static_cast<std::uint64_t>(values.size()));
    if constexpr (kAsBytes<T>) {
      append(values.data(), values.size() * sizeof(T));
    } else {
      for (const auto& value : values) add(value);
    }
  }
  template <class T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* data, std::size_t count) { bytes_.append(static_cast<const char*>(data), count); }
  std::string bytes_;
};

/// Takes values off the front of what a RecordWriter wrote. Does not own the bytes.
/// Throws DataError, naming file and record, where the bytes do not hold what is asked of them.
class RecordReader {
 public:
  /// what: the record in messages, "chunk 3".
  RecordReader(std::string_view bytes, std::string file, std::string what)
      : bytes_(bytes), file_(std::move(file)), what_(std::move(what)) {}

  template <class T>
  T take() {
    T value{};
    take(value);
    return value;
  }
  template <class T>
  void take(T& value) {
    if constexpr (kAsBytes<T>) {
      std::memcpy(static_cast<void*>(&value), need(sizeof value), sizeof value);
    } else if constexpr (SavedByFunctions<T>) {
      load(*this, value);
    } else {
      static_assert(!sizeof(T), "no way to load T: give it save(RecordWriter&, const T&) and load(RecordReader&, T&)");
    }
  }
  void take(std::string& text) {
    const auto count = take_count(1);
    text.assign(need(count), count);
  }
  template <class T>
  void take(std::vector<T>& values) {
    const auto count = take_count(kAsBytes<T> ? sizeof(T) : 1);
    values.clear();
    values.resize(count);
    if constexpr (kAsBytes<T>) {
      if (count > 0) std::memcpy(static_cast<void*>(values.data()), need(count * sizeof(T)), count * sizeof(T));
    } else {
      for (auto& value : values) take(value);
    }
  }
  template <class T>
  void take(std::optional<T>& value) {
    value.reset();
    if (take<bool>()) take(value.emplace());
  }
  /// Throws where bytes are left.
  void finish() const;
  [[noreturn]] void fail(const std::string& reason) const;
  const std::string& file() const { return file_; }

 private:
  const char* need(std::size_t count);
  /// A number of elements of at least that size that can still be there.
  std::size_t take_count(std::size_t element_bytes);
  std::string_view bytes_;
  std::string file_, what_;
};

}  // namespace ppm
