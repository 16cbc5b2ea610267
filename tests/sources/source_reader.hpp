#pragma once
#include <memory>
#include <string>

#include "framework/graph/harness.hpp"
#include "framework/roles/frame_source.hpp"
#include "tests/support/registry.hpp"

namespace ppm::test {

/// A source on its own: its frames by tick or by index, and the message of what goes wrong.
class SourceReader {
 public:
  SourceReader(const std::string& module, const std::string& params) : harness_(builtin(), module, params) {}

  FrameSource& source() { return static_cast<FrameSource&>(harness_.module()); }
  /// Null at the end of the sequence.
  std::shared_ptr<const Frame> next() { return harness_.tick() ? harness_.output<Frame>("frame") : nullptr; }
  /// Any image, whether selected or not.
  Frame image(std::int64_t index) {
    source().open_for_evaluation();
    return source().full_frame(index);
  }

 private:
  Harness harness_;
};

/// Runs a source to its end; returns the message of the DataError that it throws, or "no error".
inline std::string data_error(const std::string& module, const std::string& params) {
  try {
    SourceReader reader(module, params);
    while (reader.next()) {}
  } catch (const DataError& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace ppm::test
