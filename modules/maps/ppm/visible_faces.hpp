#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "framework/slam/frame.hpp"
#include "framework/slam/prediction.hpp"
#include "modules/maps/ppm/ppm_map.hpp"

namespace ppm {

/// The faces of a map that a view shows. Kept between views for its memory.
class VisibleFaces {
 public:
  struct Part {
    std::uint32_t chunk = 0;
    std::span<const std::uint32_t> faces;  ///< ascending, each once
  };

  /// Reads a view of the map; frame: the image that it is a view for.
  void collect(const PpmMap& map, const Prediction& view, const Frame& frame);

  /// Chunk by chunk, in the order in which the rows of the image first show them. Good until the next collect().
  const std::vector<Part>& parts() const { return parts_; }
  /// Share of the measured pixels where the map shows nothing; 0 without measurements.
  double miss_share() const {
    return measured_ == 0 ? 0.0 : static_cast<double>(missed_) / static_cast<double>(measured_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  void mark_rows(const PpmMap& map, const Prediction& view, const Frame& frame, const Rows& rows);
  void mark(const PpmMap& map, std::uint32_t chunk, std::uint32_t face);
  std::uint32_t first_word(const PpmMap& map, std::uint32_t chunk);
  void list(const PpmMap& map);

  std::vector<std::uint32_t> starts_;        // of a row
  std::vector<std::uint32_t> chunk_, face_;  // of some rows
  std::vector<std::uint32_t> first_word_;    // by chunk: of its faces in seen_, kNone for chunks that no row showed
  std::vector<std::uint32_t> chunks_;        // those that rows showed
  std::vector<std::uint64_t> seen_;          // a bit a face
  std::vector<std::uint32_t> faces_;
  std::vector<Part> parts_;
  std::size_t measured_ = 0, missed_ = 0;  // pixels
};

}  // namespace ppm
