#pragma once
#include <cstdint>
#include <initializer_list>
#include <unordered_map>
#include <vector>

#include "framework/core/record_file.hpp"
#include "framework/slam/chunk_table.hpp"

namespace ppm {

// What maps share, in a file: each part once, and maps name parts by number. See MapCodec.

/// Distinct parts in the order in which they are met. Owns none.
template <class T>
class MapParts {
 public:
  std::uint32_t number(const T* part) {
    const auto [it, added] = number_.emplace(part, static_cast<std::uint32_t>(all_.size()));
    if (added) all_.push_back(part);
    return it->second;
  }
  const std::vector<const T*>& all() const { return all_; }

 private:
  std::unordered_map<const T*, std::uint32_t> number_;
  std::vector<const T*> all_;
};

/// The part that a record names. Throws DataError where there is none of that number.
template <class T>
const T& part_of(const std::vector<T>& parts, std::uint32_t number, const RecordReader& in) {
  if (number >= parts.size()) in.fail("names a part that is not there");
  return parts[number];
}

/// One record: how many parts of each sort follow, and how many maps.
inline void save_counts(std::initializer_list<std::size_t> counts, RecordFileWriter& file) {
  RecordWriter out;
  for (auto n : counts) out.add(static_cast<std::uint64_t>(n));
  file.write(out);
}

/// A record for each part, of a type that a RecordWriter takes.
template <class Part>
void save_parts(const std::vector<const Part*>& parts, RecordFileWriter& file) {
  for (const auto* part : parts) {
    RecordWriter out;
    out.add(*part);
    file.write(out);
  }
}

/// A table of empty chunks for each of the lists of cells that save_parts() wrote. Throws DataError.
template <class Table>
std::vector<Table> load_tables(std::uint64_t count, RecordFileReader& file) {
  std::vector<Table> tables;
  for (std::uint64_t i = 0; i < count; ++i) {
    auto in = file.next(fmt::format("table of cells {}", i));
    auto& table = tables.emplace_back();
    for (const auto& cell : in.take<std::vector<Cell>>()) table.add(cell, {});
    in.finish();
  }
  return tables;
}

}  // namespace ppm
