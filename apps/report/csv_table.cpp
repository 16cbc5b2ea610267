#include "apps/report/csv_table.hpp"

#include <charconv>
#include <fstream>
#include <limits>

#include "framework/core/error.hpp"

namespace ppm::report {

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

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& file) : file_(file.string()) {
  std::ifstream in(file);
  if (!in) throw DataError(file_, "cannot be opened");
  std::string line;
  std::getline(in, line);
  names_ = fields_of(line);
  for (int number = 2; std::getline(in, line); ++number) {
    rows_.push_back(fields_of(line));
    if (rows_.back().size() == names_.size()) continue;
    throw DataError(to_string(Place{file_, number, 1}),
                    fmt::format("has {} fields, not {}", rows_.back().size(), names_.size()));
  }
}

int CsvTable::column(const std::string& name) const {
  for (std::size_t k = 0; k < names_.size(); ++k)
    if (names_[k] == name) return static_cast<int>(k);
  for (std::size_t k = 0; k < names_.size(); ++k)
    if (names_[k].substr(names_[k].rfind('.') + 1) == name) return static_cast<int>(k);
  return -1;
}

double CsvTable::number(std::size_t row, int column) const {
  const auto& field = text(row, column);
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const auto [stop, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error == std::errc() && stop == field.data() + field.size()) return value;
  throw DataError(to_string(Place{file_, static_cast<int>(row) + 2, 1}), fmt::format("'{}' is no number", field));
}

}  // namespace ppm::report
