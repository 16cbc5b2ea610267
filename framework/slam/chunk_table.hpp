#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "framework/core/cow.hpp"
#include "framework/core/error.hpp"

namespace ppm {

/// Integer coordinates of a spatial cell.
using Cell = Eigen::Vector3i;
struct CellHash {
  std::size_t operator()(const Cell& c) const {
    auto h = static_cast<std::uint64_t>(static_cast<std::uint32_t>(c.x())) * 0x9E3779B97F4A7C15ull;
    h = (h ^ static_cast<std::uint64_t>(static_cast<std::uint32_t>(c.y()))) * 0xC2B2AE3D27D4EB4Full;
    h = (h ^ static_cast<std::uint64_t>(static_cast<std::uint32_t>(c.z()))) * 0x165667B19E3779F9ull;
    return static_cast<std::size_t>(h ^ (h >> 29));
  }
};

/// The storage of a map: a table of copy-on-write chunks in the order of their creation, found by spatial cell.
/// Copying a table copies pointers; writing to a chunk clones it first if another table shares it.
/// A chunk number stays valid for the life of the table and of its copies; chunks are never removed (an empty one stays).
/// The index (cell -> number) is itself shared until a chunk is added.
/// Chunk: a copyable struct of Cow parts, for example {Cow<Geometry>, Cow<Texels>}.
template <class Chunk>
class ChunkTable {
 public:
  std::size_t size() const { return chunks_.size(); }
  const Chunk& operator[](std::size_t i) const { return chunks_[i]; }
  Chunk& edit(std::size_t i) { return chunks_[i]; }
  const std::vector<Chunk>& chunks() const { return chunks_; }
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::uint32_t find(const Cell& cell) const {
    if (!index_) return kNone;
    auto it = index_->number.find(cell);
    return it == index_->number.end() ? kNone : it->second;
  }
  /// The cell that a chunk was added for.
  const Cell& cell(std::size_t i) const { return index_->cell[i]; }
  /// The cells by chunk number, null in an empty table; the same pointer in tables that share them.
  const std::vector<Cell>* cells() const { return index_ ? &index_->cell : nullptr; }
  /// Gives back memory that was reserved.
  void shrink_to_fit() { chunks_.shrink_to_fit(); }
  /// Other chunks for the same cells.
  void replace(std::vector<Chunk> chunks) {
    PPM_CHECK(chunks.size() == chunks_.size(), "{} chunks for {} cells", chunks.size(), chunks_.size());
    chunks_ = std::move(chunks);
  }
  std::uint32_t add(const Cell& cell, Chunk chunk) {
    if (!index_) index_ = Cow<Index>::make();
    auto number = static_cast<std::uint32_t>(chunks_.size());
    auto& index = index_.write();
    index.number.emplace(cell, number);
    index.cell.push_back(cell);
    chunks_.push_back(std::move(chunk));
    return number;
  }
  /// Bytes of the table itself, without the chunks: its pointers, and the index once for all tables that share it (see Map::account).
  std::int64_t account(std::unordered_set<const void*>& seen) const {
    auto bytes = static_cast<std::int64_t>(chunks_.capacity() * sizeof(Chunk));
    if (index_ && seen.insert(index_.get()).second) bytes += static_cast<std::int64_t>(index_->cell.size()) * kIndexBytes;
    return bytes;
  }

 private:
  struct Index {
    std::unordered_map<Cell, std::uint32_t, CellHash> number;
    std::vector<Cell> cell;  // by chunk number
  };
  static constexpr std::int64_t kIndexBytes = 48;  // of a chunk: a hash node, a bucket and its cell, about
  std::vector<Chunk> chunks_;
  Cow<Index> index_;
};

}  // namespace ppm
