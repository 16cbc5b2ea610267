#pragma once
#include <string>

#include "apps/accuracy.hpp"

namespace ppm {

/// What a run leaves of its errors frame by frame, as docs/metrics.md says. Both "" where there is nothing to tell.
/// trajectory_error.csv: how far each pose lies from the reference, of the final path and of what was said at the time.
std::string trajectory_error_csv(const Accuracy& accuracy);
/// holdout.csv: what the final map predicts of each held-out frame.
std::string holdout_csv(const Accuracy& accuracy);

}  // namespace ppm
