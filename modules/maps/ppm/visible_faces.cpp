#include "modules/maps/ppm/visible_faces.hpp"

#include <algorithm>
#include <bit>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/element_rows.hpp"

namespace ppm {
namespace {

constexpr std::uint32_t kWord = 64;  // faces

std::uint32_t words_of(const PpmMap& map, std::uint32_t chunk) {
  return (static_cast<std::uint32_t>(map.table()[chunk].geometry->face.size()) + kWord - 1) / kWord;
}

}  // namespace

void VisibleFaces::collect(const PpmMap& map, const Prediction& view, const Frame& frame) {
  PPM_CHECK(view.camera == frame.camera.decimated(view.stride), "the view is not one of frame {}'s camera",
            frame.index);
  for (auto c : chunks_) first_word_[c] = kNone;  // of the view before
  first_word_.resize(map.table().size(), kNone);
  chunks_.clear();
  seen_.clear();
  measured_ = missed_ = 0;
  constexpr int kBand = 16;  // rows: what is read of them stays in the nearest cache
  for (int y = 0; y < view.camera.rows; y += kBand)
    mark_rows(map, view, frame, {y, std::min(y + kBand, view.camera.rows)});
  list(map);
}

void VisibleFaces::mark_rows(const PpmMap& map, const Prediction& view, const Frame& frame, const Rows& rows) {
  const auto cols = static_cast<std::size_t>(view.camera.cols), stride = static_cast<std::size_t>(view.stride);
  chunk_.resize(static_cast<std::size_t>(rows.end - rows.first) * cols);
  face_.resize(chunk_.size());
  starts_.resize(cols + kStartsPad);
  view.elements(rows, chunk_, face_);
  for (int y = rows.first; y < rows.end; ++y) {
    const auto at = static_cast<std::size_t>(y - rows.first) * cols;
    const auto source = static_cast<std::size_t>(y) * stride * static_cast<std::size_t>(frame.camera.cols);
    const ElementRow row{&chunk_[at], &face_[at], &frame.depth[source], stride, cols};
    const RowCounts counts = read_row(row, starts_.data());
    measured_ += counts.measured;
    missed_ += counts.missed;
    for (std::size_t i = 0; i < counts.starts; ++i)
      if (const auto p = starts_[i]; row.chunk[p] != Prediction::kNone) mark(map, row.chunk[p], row.face[p]);
  }
}

void VisibleFaces::mark(const PpmMap& map, std::uint32_t chunk, std::uint32_t face) {
  const std::uint32_t first = first_word(map, chunk);
  seen_[first + face / kWord] |= std::uint64_t{1} << (face % kWord);
}

std::uint32_t VisibleFaces::first_word(const PpmMap& map, std::uint32_t chunk) {
  std::uint32_t& first = first_word_[chunk];
  if (first == kNone) {
    first = static_cast<std::uint32_t>(seen_.size());
    seen_.resize(first + words_of(map, chunk), 0);
    chunks_.push_back(chunk);
  }
  return first;
}

void VisibleFaces::list(const PpmMap& map) {
  std::size_t count = 0;
  for (auto word : seen_) count += static_cast<std::size_t>(std::popcount(word));
  faces_.resize(count);
  parts_.clear();
  std::uint32_t* next = faces_.data();
  for (auto c : chunks_) {
    std::uint32_t* const first = next;
    for (std::uint32_t w = 0; w < words_of(map, c); ++w)
      for (auto word = seen_[first_word_[c] + w]; word != 0; word &= word - 1)
        *next++ = w * kWord + static_cast<std::uint32_t>(std::countr_zero(word));
    parts_.push_back({c, {first, next}});
  }
}

}  // namespace ppm
