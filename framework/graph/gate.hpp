#pragma once
#include <cstdint>
#include <limits>
#include <string>

#include "framework/config/params.hpp"

namespace ppm {

/// When a node runs. It runs in frame f if from_frame <= f <= until_frame and (f - from_frame) % every == 0; with
/// at_end only once, after the last frame. A node that does not run is the identity.
struct Gate {
  static constexpr std::int64_t kForever = std::numeric_limits<std::int64_t>::max();
  std::int64_t from_frame = 0;
  std::int64_t until_frame = kForever;
  std::int64_t every = 1;
  bool at_end = false;

  bool open(std::int64_t frame) const {
    return !at_end && frame >= from_frame && frame <= until_frame && (frame - from_frame) % every == 0;
  }
  /// True where it is open in every frame.
  bool always() const { return !at_end && from_frame == 0 && until_frame == kForever && every == 1; }
  /// Declares the keys of `when:`, bound to this gate.
  void declare(Params& params);
  /// Reads a `when:` map (null: always open). Appends every mistake to `out`.
  void parse(const Config* when, const Place& node, Diagnostics& out);
  /// The keys that differ from an always open gate.
  Config effective() const;
};

}  // namespace ppm
