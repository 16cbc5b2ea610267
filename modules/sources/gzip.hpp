#pragma once
#include <string>

namespace ppm {

/// What gunzip made of a file. error is empty when the file is whole.
struct Unzipped {
  std::string bytes;
  std::string error;
};

/// Unpacks a gzip file in memory; bytes without gzip's signature are given back as they are. Never throws on bad data.
Unzipped gunzip(std::string file_bytes);

}  // namespace ppm
