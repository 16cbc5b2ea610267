#include "apps/metrics_table.hpp"

#include <charconv>
#include <cmath>
#include <fstream>

#include "framework/core/error.hpp"

namespace ppm {

namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  for (std::size_t first = 0; first <= line.size();) {
    const auto end = std::min(line.find(',', first), line.size());
    fields.push_back(line.substr(first, end - first));
    first = end + 1;
  }
  return fields;
}

std::string last_part(const std::string& column) {
  return column.substr(column.rfind('.') + 1);
}

}  // namespace

MetricsTable read_metrics(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw DataError(file.string(), "cannot be opened; sink.metrics writes it");
  std::string line;
  std::getline(in, line);
  const auto names = fields_of(line);
  if (names.empty() || names[0] != "frame")
    throw DataError(to_string(Place{file.string(), 1, 1}), "is no table of metrics");
  MetricsTable table;
  for (std::size_t k = 1; k < names.size(); ++k) table[names[k]];
  for (int number = 2; std::getline(in, line); ++number) {
    auto fail = [&](const std::string& reason) { throw DataError(to_string(Place{file.string(), number, 1}), reason); };
    auto value = [&](const std::string& field) {
      double v = 0;
      const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), v);
      if (error != std::errc() || stop != field.data() + field.size()) fail(fmt::format("'{}' is no number", field));
      return v;
    };
    const auto fields = fields_of(line);
    if (fields.size() != names.size()) fail(fmt::format("has {} fields, not {}", fields.size(), names.size()));
    const double frame = value(fields[0]);
    for (std::size_t k = 1; k < fields.size(); ++k) {
      if (fields[k].empty()) continue;
      const double v = value(fields[k]);
      if (std::isfinite(v)) table[names[k]].emplace_back(frame, v);
    }
  }
  return table;
}

std::string find_column(const MetricsTable& table, const std::string& name) {
  if (table.contains(name)) return name;
  for (const auto& [column, points] : table)
    if (last_part(column) == name) return column;
  return "";
}

std::vector<std::string> column_names(const MetricsTable& table) {
  std::vector<std::string> names;
  for (const auto& [column, points] : table) {
    names.push_back(column);
    names.push_back(last_part(column));
  }
  return names;
}

}  // namespace ppm
