#pragma once
#include <string>
#include <utility>
#include <vector>

namespace ppm::report {

/// Values of a graph file by "node.key", in the order of the file: the module, wires ("node.in.frame"), gates
/// ("node.when.every") and parameters ("node.sigma_t"). Throws ConfigError where the text is no YAML.
std::vector<std::pair<std::string, std::string>> graph_values(const std::string& yaml, const std::string& name);

/// A key whose value differs; "" where a side has it not.
struct ValueChange {
  std::string key, left, right;
};
std::vector<ValueChange> value_changes(const std::vector<std::pair<std::string, std::string>>& left,
                                       const std::vector<std::pair<std::string, std::string>>& right);

/// A line of either text: ' ' of both, '-' of the left alone, '+' of the right alone.
struct DiffLine {
  char mark;
  std::string text;
};
/// With the longest common subsequence of lines kept.
std::vector<DiffLine> line_diff(const std::string& left, const std::string& right);

}  // namespace ppm::report
