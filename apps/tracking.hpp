#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "framework/graph/graph.hpp"
#include "framework/graph/metrics.hpp"

namespace ppm {

/// Whether a run held on to its camera, as its recovery.* node said frame by frame.
struct Tracking {
  std::string judge;  ///< that node; "" where there is none, and nobody knows
  std::int64_t frames = 0;              ///< that were judged
  std::int64_t unexplained_frames = 0;  ///< in which no particle explained the image, lost or not
  std::int64_t lost_frames = 0, longest_lost = 0;  ///< frames; frames in a row
  std::optional<std::int64_t> first_lost;          ///< number of the frame in the run
  bool lost_at_end = false;
};

/// From the node's metrics `lost` and `unexplained`, 1 or 0.
Tracking tracking_of(const Graph& graph, const Metrics& metrics);
/// A line for the terminal; "" where nobody knows.
std::string tracking_line(const Tracking& tracking);

}  // namespace ppm
