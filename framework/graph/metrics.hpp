#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "framework/core/record.hpp"

namespace ppm {

/// Numbers by frame: a table whose columns appear as they are first recorded. Only the executor's thread writes.
class Metrics {
 public:
  struct Row {
    std::int64_t frame;
    double value;
  };
  void record(std::int64_t frame, const std::string& column, double value) {
    columns_[column].push_back({frame, value});
  }
  /// Columns in alphabetical order; rows in order of frames.
  const std::map<std::string, std::vector<Row>>& columns() const { return columns_; }
  /// CSV with a header, one line a frame; an empty field where nothing was recorded.
  std::string to_csv() const;

  void save(RecordWriter& out) const;
  void load(RecordReader& in);

 private:
  std::map<std::string, std::vector<Row>> columns_;
};

}  // namespace ppm
