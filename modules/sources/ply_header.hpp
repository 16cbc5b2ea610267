#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ppm {

/// A number type of PLY files.
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t size_of(PlyType type);
/// The number that the first size_of(type) bytes are, little endian.
double ply_number(PlyType type, const char* bytes);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  bool ascii = false;  ///< else binary, little endian
  std::vector<PlyElement> elements;
  std::size_t body = 0;  ///< byte where the data begins
  int body_line = 0;     ///< its line, counted from 1
};

/// Reads the header of a PLY file. file: for messages. Throws DataError naming file and line.
PlyHeader read_ply_header(const std::filesystem::path& file, std::string_view bytes);

}  // namespace ppm
