#include "apps/compare/fields.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <regex>

#include "framework/graph/graph_builder.hpp"

namespace ppm {

void read_fields(const Config& map, const std::string& owner, Params& plain, const std::vector<std::string>& other,
                 Diagnostics& mistakes) {
  std::vector<std::string> known = other;
  for (const auto& spec : plain.specs()) known.push_back(spec.name());
  std::ranges::sort(known);
  Config values = Config::map(map.place());
  for (const auto& entry : map.entries()) {
    if (plain.find(entry.key)) {
      values.set(entry.key, entry.key_place, entry.value);
    } else if (std::ranges::find(other, entry.key) == other.end()) {
      auto hint = suggestion(entry.key, known);
      if (hint.empty()) hint = fmt::format("; keys: {}", fmt::join(known, ", "));
      mistakes.push_back({entry.key_place, fmt::format("unknown key '{}' of {}{}", entry.key, owner, hint)});
    }
  }
  plain.parse(&values, owner, map.place(), mistakes);
}

const Config* field(const Config& map, const std::string& key, Config::Kind kind, Diagnostics& mistakes) {
  const Config* value = map.find(key);
  if (!value || value->kind() == kind) return value;
  mistakes.push_back({value->place(), fmt::format("'{}' must be a {}, not {}", key, kind_name(kind), a_kind(*value))});
  return nullptr;
}

bool is_map(const Config& value, const std::string& what, const std::string& example, Diagnostics& mistakes) {
  if (value.kind() == Config::Kind::map) return true;
  mistakes.push_back({value.place(), fmt::format("{} is a map such as {}, not {}", what, example, a_kind(value))});
  return false;
}

std::vector<std::pair<std::string, Place>> read_words(const Config& list, const std::string& what, Diagnostics& mistakes) {
  std::vector<std::pair<std::string, Place>> words;
  for (const auto& item : list.items()) {
    if (item.kind() == Config::Kind::scalar) {
      words.emplace_back(item.text(), item.place());
    } else {
      mistakes.push_back({item.place(), fmt::format("{}, not {}", what, a_kind(item))});
    }
  }
  return words;
}

std::filesystem::path path_beside(const Place& place, const std::filesystem::path& written) {
  return (std::filesystem::path(place.file).parent_path() / written).lexically_normal();
}

void check_name(const std::string& name, const Place& place, const std::string& what, Diagnostics& mistakes) {
  static const std::regex pattern("[A-Za-z0-9_][A-Za-z0-9_.-]*");
  if (std::regex_match(name, pattern)) return;
  mistakes.push_back(
      {place, fmt::format("{} '{}': letters, digits, '_', '-' and '.', not '-' or '.' first", what, name)});
}

}  // namespace ppm
