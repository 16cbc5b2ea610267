#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "apps/report/suite_folder.hpp"

namespace ppm::report {

/// What a run's CSV files tell frame by frame; a file or column that is absent gives no curve.
///   ate, ate_online                      error of the path after alignment, cm, against the time since its first
///   frame, s holdout.POSES                        median error of a held-out frame, mm, against its number (POSES:
///   reference, estimated, ...) memory                               map of all particles, MiB, against the frame
///   cpu_ms                               time of all threads on processors, ms, against the frame
std::map<std::string, Curve> read_curves(const std::filesystem::path& run);

}  // namespace ppm::report
