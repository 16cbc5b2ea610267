#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace ppm::test {

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// A square of 4 x 4 m in the plane x = 2, its middle at the height 1, and a smaller one of 1 x 1 m before it at x = 1; ascii,
/// quads, with a property and an element that nobody needs.
inline std::string two_squares() {
  return "ply\nformat ascii 1.0\ncomment two squares\nelement vertex 8\nproperty float x\nproperty float y\n"
         "property float z\nproperty uchar red\nelement face 2\nproperty list uchar int vertex_indices\n"
         "element edge 1\nproperty int a\nend_header\n"
         "2 -2 -1 9\n2 2 -1 9\n2 2 3 9\n2 -2 3 9\n"
         "1 -0.5 0.5 9\n1 0.5 0.5 9\n1 0.5 1.5 9\n1 -0.5 1.5 9\n"
         "4 0 1 2 3\n4 4 5 6 7\n7\n";
}

/// A square as a binary file of two triangles; `corner` is the last corner of the second one.
inline std::string binary_square(std::uint32_t corner = 3) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 2\nproperty list uchar uint vertex_index\nend_header\n";
  const auto add = [&](auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    text.append(bytes, sizeof value);
  };
  for (const double y : {-1.0, 1.0})
    for (const double z : {-1.0, 1.0}) add(3.0), add(y), add(z);
  for (const auto& face : {std::array<std::uint32_t, 3>{0, 1, 2}, {2, 1, corner}}) {
    add(std::uint8_t{3});
    for (const std::uint32_t v : face) add(v);
  }
  return text;
}

}  // namespace ppm::test
