#include "framework/graph/metrics.hpp"

#include <fmt/format.h>

namespace ppm {

std::string Metrics::to_csv() const {
  std::map<std::int64_t, std::vector<std::string>> rows;
  std::string text = "frame";
  std::size_t column = 0;
  for (const auto& [name, values] : columns_) {
    text += "," + name;
    for (const auto& row : values) {
      auto& fields = rows[row.frame];
      fields.resize(columns_.size());
      fields[column] = fmt::format("{}", row.value);
    }
    ++column;
  }
  text += '\n';
  for (const auto& [frame, fields] : rows) text += fmt::format("{},{}\n", frame, fmt::join(fields, ","));
  return text;
}

void Metrics::save(RecordWriter& out) const {
  out.add(static_cast<std::uint64_t>(columns_.size()));
  for (const auto& [name, rows] : columns_) {
    out.add(name);
    out.add(rows);
  }
}

void Metrics::load(RecordReader& in) {
  columns_.clear();
  for (auto n = in.take<std::uint64_t>(); n > 0; --n) {
    const auto name = in.take<std::string>();
    in.take(columns_[name]);
  }
}

}  // namespace ppm
