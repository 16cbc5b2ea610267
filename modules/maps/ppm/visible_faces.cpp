#include "modules/maps/ppm/visible_faces.hpp"

#include <algorithm>
#include <bit>

#include "framework/core/error.hpp"

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
  view.elements(rows, chunk_, face_);
  std::uint32_t chunk = kNone, face = kNone, first = 0;  // of the last pixel
  std::size_t p = 0;
  for (int y = rows.first; y < rows.end; ++y) {
    const float* depth =
        &frame.depth[static_cast<std::size_t>(y) * stride * static_cast<std::size_t>(frame.camera.cols)];
    for (std::size_t x = 0; x < cols; ++x, ++p, depth += stride) {
      const bool measured = *depth == *depth;
      measured_ += measured;
      missed_ += measured && chunk_[p] == Prediction::kNone;
      if ((chunk_[p] == chunk && face_[p] == face) || chunk_[p] == Prediction::kNone) continue;
      if (chunk_[p] != chunk) first = first_word(map, chunk_[p]);
      chunk = chunk_[p];
      face = face_[p];
      seen_[first + face / kWord] |= std::uint64_t{1} << (face % kWord);
    }
  }
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
