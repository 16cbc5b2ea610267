#pragma once
#include <mrpt/serialization/CSerializable.h>
#include <string>
#include <vector>

#include "modules/rawlog/spool.hpp"

namespace ppm {

/// Reads the objects of a rawlog one after another.
class ObjectStream {
 public:
  /// Both stay the caller's. name: of the file, for messages.
  ObjectStream(const Spool& spool, std::string name);
  ~ObjectStream();
  /// The next object, or null at the end. Throws DataError with the entry and the byte where it is cut short, damaged, or of a
  /// class that MRPT does not know.
  mrpt::serialization::CSerializable::Ptr next();
  /// Where the object that next() gave begins, and where it ends.
  std::uint64_t begin() const { return begin_; }
  std::uint64_t end() const;

 private:
  struct Bytes;
  std::string name_;
  std::uint64_t size_;
  std::uint64_t begin_ = 0;
  std::size_t entry_ = 0;
  std::unique_ptr<Bytes> bytes_;
};

/// One object from its place. Throws what MRPT throws.
mrpt::serialization::CSerializable::Ptr object_at(const Spool& spool, std::uint64_t begin, std::uint64_t end);

/// The reason in a message of MRPT, which are of many lines.
std::string reason_of(const std::exception& error);

}  // namespace ppm
