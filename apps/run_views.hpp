#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "framework/core/parallel.hpp"
#include "framework/graph/graph.hpp"
#include "framework/slam/map.hpp"
#include "framework/slam/trajectory.hpp"

namespace ppm {

/// `count` of the held-out frames up to the last mapped one, evenly over them: the same for every map, for a length of the run.
std::vector<std::int64_t> frames_to_view(const std::vector<std::int64_t>& held_out, std::int64_t last, std::size_t count);

/// Draws what was measured, what the map says, and the error between them, of `count` held-out frames, as docs/metrics.md
/// says: PNG files and views.json in folder/views. They are looked at from the reference poses where the source has them,
/// else from the path's. Nothing where no frame was held out or the graph cannot look at the map; a frame without a pose
/// is left out. path, last: as of measure_accuracy(). Throws DataError, OutputError.
void write_views(const std::filesystem::path& folder, const Graph& graph, const std::vector<StampedPose>& path,
                 std::int64_t last, const Map* map, std::size_t count, const Workers& workers);

}  // namespace ppm
