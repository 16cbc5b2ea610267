#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ppm {

/// Reads a text file of exactly `count` finite numbers, separated by white space. Throws DataError naming the file, the
/// frame (where the file is of one) and the first thing that is wrong.
std::vector<double> read_numbers(const std::filesystem::path& file, std::optional<std::int64_t> frame,
                                 std::size_t count);

/// The number that is the whole of `word`, whatever the locale; empty where it is none. "nan" and "inf" are numbers
/// here.
std::optional<double> parse_number(std::string_view word);

/// The words of a line, separated by white space.
std::vector<std::string> split_words(std::string_view line);

}  // namespace ppm
