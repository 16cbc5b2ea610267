#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace ppm {

/// Which images of a sequence are mapped, and which are held out to test the map on. Ascending indices.
struct FrameSelection {
  std::vector<std::int64_t> mapped;
  std::vector<std::int64_t> held_out;
  /// Those that are mapped and, behind the first of them, those held out, in the order of the sequence.
  std::vector<std::int64_t> followed() const;
};

/// N of "every Nth" (N >= 2, with its English ending: "every 10th", "every 3rd"), 0 for "none", -1 for anything else.
std::int64_t parse_holdout(const std::string& text);

/// Images first, first + stride, ... up to last (-1 = the end) are mapped, unless they are held out; every image in
/// [first, last] with index % holdout_every == holdout_every / 2 is held out, whatever the stride (0 = none is).
/// name: of the sequence, for messages. Throws DataError where a bound lies beyond the end or nothing is left to map.
FrameSelection select_frames(const std::string& name, std::int64_t images, std::int64_t first, std::int64_t last,
                             std::int64_t stride, std::int64_t holdout_every);

}  // namespace ppm
