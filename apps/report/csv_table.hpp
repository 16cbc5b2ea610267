#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace ppm::report {

/// A CSV file with a line of names (no quotes, no commas in fields, as all files of a run are).
class CsvTable {
 public:
  /// Throws DataError with file and line.
  explicit CsvTable(const std::filesystem::path& file);

  std::size_t rows() const { return rows_.size(); }
  /// The column of that name, or the first whose part behind the last dot it is ("map_bytes_owned" of
  /// "table.map_bytes_owned"); -1 where there is none.
  int column(const std::string& name) const;
  const std::string& text(std::size_t row, int column) const { return rows_[row][static_cast<std::size_t>(column)]; }
  /// NaN for an empty field. Throws DataError where it is no number.
  double number(std::size_t row, int column) const;

 private:
  std::string file_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace ppm::report
