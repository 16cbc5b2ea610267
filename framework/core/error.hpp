#pragma once
#include <fmt/core.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace ppm {

/// A place in a text that the user wrote. Lines and columns count from 1; line 0 means "the file as a whole".
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};
/// "file:3:7", or "file" where the line is unknown.
std::string to_string(const Place& place);

/// One thing that is wrong, and where.
struct Diagnostic {
  Place place;
  std::string message;
};
using Diagnostics = std::vector<Diagnostic>;

class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : runtime_error(message), text_(message) {}
  const char* what() const noexcept override { return text_.c_str(); }
  /// Says where it happened, behind the message: "... (node 'look', frame 12)". Callers rethrow with `throw;`, so that the
  /// type is kept.
  void add_context(const std::string& where) { text_ += " (" + where + ")"; }

 private:
  std::string text_;
};

/// The user's file or command line is wrong. Carries every mistake that was found; what() has one line for each.
class ConfigError : public Error {
 public:
  explicit ConfigError(Diagnostics diagnostics);
  ConfigError(Place place, std::string message);
  const Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  Diagnostics diagnostics_;
};

/// The input data is wrong. what() names the file and, where there is one, the frame (the source's own index).
class DataError : public Error {
 public:
  DataError(const std::string& file, const std::string& reason);
  DataError(const std::string& file, std::int64_t frame, const std::string& reason);
};

/// Writing an output failed (a full disk, no permission). what() names the file and the system's reason.
class OutputError : public Error {
 public:
  using Error::Error;
};

/// A bug of ours: thrown by PPM_CHECK.
class InternalError : public Error {
 public:
  using Error::Error;
};

[[noreturn]] void check_failed(const char* file, int line, const char* condition, const std::string& message);

}  // namespace ppm

/// Checks our own invariants (never the user's input), in every build type. Use: PPM_CHECK(i < n, "i {} n {}", i, n).
#define PPM_CHECK(condition, ...)                                                            \
  do {                                                                                       \
    if (!(condition)) ::ppm::check_failed(__FILE__, __LINE__, #condition, fmt::format(__VA_ARGS__)); \
  } while (false)
