#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "framework/core/atomic_file.hpp"
#include "framework/core/record.hpp"

namespace ppm {

// A file of records: 8 characters that say what it is, then records. A record is: u64 length of the payload, payload, 32
// characters of its hash (XXH3, see Digest). What the records mean, and a version, is the matter of who writes them.

/// Writes such a file; it appears under its name by commit(), complete. Throws OutputError.
class RecordFileWriter {
 public:
  RecordFileWriter(std::filesystem::path file, std::string_view magic);
  void write(const RecordWriter& record);
  void commit() { file_.commit(); }
  std::uint64_t bytes() const { return bytes_; }  ///< written so far

 private:
  AtomicFile file_;
  std::uint64_t bytes_ = 0;
};

/// Reads such a file, record by record. Throws DataError, naming the file, the record and the byte where it is cut short or
/// was altered.
class RecordFileReader {
 public:
  /// kind: what the file should be, in messages: "a map.ppm".
  RecordFileReader(const std::filesystem::path& file, std::string_view magic, const std::string& kind);
  RecordFileReader(const RecordFileReader&) = delete;
  RecordFileReader& operator=(const RecordFileReader&) = delete;

  /// The next record, good as long as this reader. what: the record in messages, "chunk 3".
  RecordReader next(const std::string& what);
  /// Throws where the file goes on. last: the last record in messages.
  void finish(const std::string& last) const;
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace ppm
