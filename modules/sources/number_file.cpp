#include "modules/sources/number_file.hpp"

#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <sstream>

#include "modules/sources/file_bytes.hpp"

namespace ppm {

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::vector<std::string> split_words(std::string_view line) {
  std::istringstream in{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(std::move(word));
  return words;
}

std::vector<double> read_numbers(const std::filesystem::path& file, std::optional<std::int64_t> frame,
                                 std::size_t count) {
  std::vector<double> numbers;
  for (const auto& word : split_words(read_bytes(file, frame))) {
    auto number = parse_number(word);
    if (!number) throw_data_error(file, frame, fmt::format("'{}' is not a number", word));
    if (!std::isfinite(*number)) throw_data_error(file, frame, fmt::format("'{}' is not a finite number", word));
    numbers.push_back(*number);
  }
  if (numbers.size() != count)
    throw_data_error(file, frame, fmt::format("has {} numbers; it must have {}", numbers.size(), count));
  return numbers;
}

}  // namespace ppm
