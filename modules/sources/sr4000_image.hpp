#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

namespace ppm {

/// One image of a SwissRanger camera as its driver writes it.
struct Sr4000Image {
  int cols = 0, rows = 0;
  /// [rows*cols] m, row-major. The camera's own frame: x to the left of the image, y up, z forward.
  std::vector<float> z, x, y;
  std::vector<float> amplitude;   ///< [rows*cols] of the light that came back, made up for the distance; 0 = none
  std::vector<float> confidence;  ///< [rows*cols] 0 (none) .. 7
};

/// Reads a text file, packed with gzip or not: blocks that begin with a line "% name", then a line an image row. Blocks
/// wanted: Calibrated Distance, Calibrated xVector, Calibrated yVector, Amplitude, Confidence map; others are passed
/// over. Throws DataError naming file, frame, line and what is wrong.
Sr4000Image read_sr4000(const std::filesystem::path& file, std::int64_t frame);

}  // namespace ppm
