#include "apps/report/config_changes.hpp"

#include <algorithm>
#include <sstream>

#include "framework/config/config.hpp"

namespace ppm::report {

namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

std::string one_line(const Config& value) {
  if (value.kind() == Config::Kind::scalar) return value.text();
  std::string text = "[";
  for (const auto& item : value.items()) text += (text.size() > 1 ? ", " : "") + one_line(item);
  return text + "]";
}

void add_values(const Config& value, const std::string& path, Values& values) {
  if (value.kind() != Config::Kind::map) {
    values.emplace_back(path, one_line(value));
    return;
  }
  for (const auto& entry : value.entries())
    add_values(entry.value, entry.key == "params" ? path : path + "." + entry.key, values);
}

const std::string* find(const Values& values, const std::string& key) {
  const auto found = std::ranges::find(values, key, &Values::value_type::first);
  return found == values.end() ? nullptr : &found->second;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

Values graph_values(const std::string& yaml, const std::string& name) {
  Values values;
  const auto graph = parse_yaml(yaml, name);
  const auto* nodes = graph.kind() == Config::Kind::map ? graph.find("nodes") : nullptr;
  if (!nodes) return values;
  for (const auto& node : nodes->items()) {
    if (node.kind() != Config::Kind::map) continue;
    const auto* node_name = node.find("name");
    if (!node_name) continue;
    for (const auto& entry : node.entries())
      if (entry.key != "name")
        add_values(entry.value, entry.key == "params" ? node_name->text() : node_name->text() + "." + entry.key,
                   values);
  }
  return values;
}

std::vector<ValueChange> value_changes(const Values& left, const Values& right) {
  std::vector<ValueChange> changes;
  for (const auto& [key, value] : left) {
    const auto* other = find(right, key);
    if (!other || *other != value) changes.push_back({key, value, other ? *other : ""});
  }
  for (const auto& [key, value] : right)
    if (!find(left, key)) changes.push_back({key, "", value});
  return changes;
}

std::vector<DiffLine> line_diff(const std::string& left, const std::string& right) {
  const auto a = lines_of(left), b = lines_of(right);
  // common[i][j]: lines that a[i..] and b[j..] share in order
  std::vector common(a.size() + 1, std::vector<int>(b.size() + 1, 0));
  for (std::size_t i = a.size(); i-- > 0;)
    for (std::size_t j = b.size(); j-- > 0;)
      common[i][j] = a[i] == b[j] ? common[i + 1][j + 1] + 1 : std::max(common[i + 1][j], common[i][j + 1]);
  std::vector<DiffLine> diff;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    if (i < a.size() && j < b.size() && a[i] == b[j]) {
      diff.push_back({' ', a[i]});
      ++i, ++j;
    } else if (j == b.size() || (i < a.size() && common[i + 1][j] >= common[i][j + 1])) {
      diff.push_back({'-', a[i++]});
    } else {
      diff.push_back({'+', b[j++]});
    }
  }
  return diff;
}

}  // namespace ppm::report
