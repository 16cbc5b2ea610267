#include "modules/sources/sr4000_image.hpp"

#include <array>
#include <cmath>
#include <fmt/core.h>
#include <string_view>

#include "modules/sources/file_bytes.hpp"
#include "modules/sources/gzip.hpp"
#include "modules/sources/number_file.hpp"

namespace ppm {
namespace {

/// A matrix of the file as it grows.
struct Block {
  std::string_view name;
  std::vector<float>* values;
  int rows = 0;
};

/// The next word of a line, and the line after it; empty at the end.
std::string_view next_word(std::string_view& line) {
  constexpr std::string_view kSpace = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
  const auto word = line.substr(0, line.find_first_of(kSpace));
  line.remove_prefix(word.size());
  return word;
}

class Reader {
 public:
  Reader(const std::filesystem::path& file, std::int64_t frame) : file_(file), frame_(frame) {}

  Sr4000Image read(std::string_view text) {
    Block* block = nullptr;
    for (line_ = 1; !text.empty(); ++line_) {
      std::string_view line = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(line.size() + 1, text.size()));
      if (line.starts_with('%'))
        block = find_block(line.substr(1));
      else if (block && line.find_first_not_of(" \t\r") != std::string_view::npos)
        read_row(line, *block);
    }
    check();
    return std::move(image_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { throw_data_error(file_, frame_, reason); }

  Block* find_block(std::string_view title) {
    title.remove_prefix(std::min(title.find_first_not_of(' '), title.size()));
    for (auto& block : blocks_)
      if (title.starts_with(block.name)) {
        if (block.rows > 0) fail(fmt::format("line {}: a second block '{}'", line_, block.name));
        return &block;
      }
    return nullptr;
  }

  void read_row(std::string_view line, Block& block) {
    int count = 0;
    for (auto word = next_word(line); !word.empty(); word = next_word(line), ++count) {
      const auto number = parse_number(word);
      if (!number || !std::isfinite(*number)) fail(fmt::format("line {}: '{}' is not a finite number", line_, word));
      block.values->push_back(static_cast<float>(*number));
    }
    if (image_.cols == 0) image_.cols = count;
    if (count != image_.cols)
      fail(fmt::format("line {} has {} numbers; rows began with {}", line_, count, image_.cols));
    ++block.rows;
  }

  void check() {
    image_.rows = blocks_.front().rows;
    for (const auto& block : blocks_) {
      if (block.rows == 0) fail(fmt::format("has no block '% {}'", block.name));
      if (block.rows != image_.rows)
        fail(fmt::format("its block '{}' has {} rows, '{}' has {}", block.name, block.rows, blocks_.front().name,
                         image_.rows));
    }
  }

  const std::filesystem::path& file_;
  std::int64_t frame_;
  int line_ = 0;
  Sr4000Image image_;
  std::array<Block, 5> blocks_{Block{"Calibrated Distance", &image_.z}, Block{"Calibrated xVector", &image_.x},
                               Block{"Calibrated yVector", &image_.y}, Block{"Amplitude", &image_.amplitude},
                               Block{"Confidence map", &image_.confidence}};
};

}  // namespace

Sr4000Image read_sr4000(const std::filesystem::path& file, std::int64_t frame) {
  const Unzipped text = gunzip(read_bytes(file, frame));
  if (!text.error.empty()) throw_data_error(file, frame, "cannot be unpacked: " + text.error);
  return Reader(file, frame).read(text.bytes);
}

}  // namespace ppm
