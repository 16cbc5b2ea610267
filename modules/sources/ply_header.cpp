#include "modules/sources/ply_header.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>

#include "framework/core/error.hpp"
#include "modules/sources/number_file.hpp"

namespace ppm {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY files are read as they lie in memory");

struct TypeName {
  const char *name, *alias;
};
constexpr std::array<TypeName, 8> kTypeNames{{{"char", "int8"},
                                              {"uchar", "uint8"},
                                              {"short", "int16"},
                                              {"ushort", "uint16"},
                                              {"int", "int32"},
                                              {"uint", "uint32"},
                                              {"float", "float32"},
                                              {"double", "float64"}}};

std::optional<PlyType> type_named(const std::string& name) {
  const auto found = std::find_if(kTypeNames.begin(), kTypeNames.end(),
                                  [&](const TypeName& t) { return name == t.name || name == t.alias; });
  if (found == kTypeNames.end()) return std::nullopt;
  return static_cast<PlyType>(found - kTypeNames.begin());
}

template <class T>
double read_as(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

/// Takes a header's lines one by one.
class HeaderReader {
 public:
  HeaderReader(const std::filesystem::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  PlyHeader read() {
    if (next() != std::vector<std::string>{"ply"}) fail("is no PLY file: it does not begin with the line 'ply'");
    while (true) {
      const auto words = next();
      if (words == std::vector<std::string>{"end_header"}) break;
      take(words);
    }
    if (!has_format_) fail("the header names no format");
    header_.body = at_;
    header_.body_line = line_ + 1;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw DataError(to_string(Place{file_.string(), line_, 1}), reason);
  }
  std::vector<std::string> next() {
    ++line_;
    const auto end = bytes_.find('\n', at_);
    if (end == std::string_view::npos) fail("the file ends within the header");
    auto words = split_words(bytes_.substr(at_, end - at_));
    at_ = end + 1;
    return words;
  }
  void take(const std::vector<std::string>& words) {
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return;
    if (words[0] == "format") return take_format(words);
    if (words[0] == "element") return take_element(words);
    if (words[0] == "property") return take_property(words);
    fail(fmt::format("'{}' begins no line of a header", words[0]));
  }
  void take_format(const std::vector<std::string>& words) {
    if (words.size() != 3 || words[2] != "1.0" || (words[1] != "ascii" && words[1] != "binary_little_endian"))
      fail("the format is neither 'ascii 1.0' nor 'binary_little_endian 1.0'");
    header_.ascii = words[1] == "ascii";
    has_format_ = true;
  }
  void take_element(const std::vector<std::string>& words) {
    if (words.size() != 3) fail("an element has the form 'element NAME COUNT'");
    PlyElement element{words[1], 0, {}};
    const char* end = words[2].data() + words[2].size();
    const auto [stop, error] = std::from_chars(words[2].data(), end, element.count);
    if (error != std::errc() || stop != end) fail(fmt::format("'{}' is no number of elements", words[2]));
    header_.elements.push_back(std::move(element));
  }
  void take_property(const std::vector<std::string>& words) {
    if (header_.elements.empty()) fail("a property stands before the first element");
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3) fail("a property has the form 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    PlyProperty property{words.back(), type(words[words.size() - 2]), is_list, PlyType::uint8};
    if (is_list) property.count_type = type(words[2]);
    header_.elements.back().properties.push_back(std::move(property));
  }
  PlyType type(const std::string& name) const {
    const auto found = type_named(name);
    if (!found) fail(fmt::format("'{}' is no type of PLY files", name));
    return *found;
  }

  const std::filesystem::path& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  int line_ = 0;
  bool has_format_ = false;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

double ply_number(PlyType type, const char* bytes) {
  switch (type) {
    case PlyType::int8:
      return read_as<std::int8_t>(bytes);
    case PlyType::uint8:
      return read_as<std::uint8_t>(bytes);
    case PlyType::int16:
      return read_as<std::int16_t>(bytes);
    case PlyType::uint16:
      return read_as<std::uint16_t>(bytes);
    case PlyType::int32:
      return read_as<std::int32_t>(bytes);
    case PlyType::uint32:
      return read_as<std::uint32_t>(bytes);
    case PlyType::float32:
      return read_as<float>(bytes);
    case PlyType::float64:
      return read_as<double>(bytes);
  }
  PPM_CHECK(false, "a type of PLY files, number {}", static_cast<int>(type));
}

PlyHeader read_ply_header(const std::filesystem::path& file, std::string_view bytes) {
  return HeaderReader(file, bytes).read();
}

}  // namespace ppm
